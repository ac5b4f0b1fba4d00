"""Reads OpenEXR pictures of one part in scan lines, uncompressed or ZIP, as sprung and Blender write them."""
import struct
import zlib

import numpy

LINES = {0: 1, 2: 1, 3: 16}  # in a chunk, by compression: none, ZIPS, ZIP
KINDS = {0: numpy.dtype("<u4"), 1: numpy.dtype("<f2"), 2: numpy.dtype("<f4")}


def text_at(data, at):
    end = data.index(b"\0", at)
    return data[at:end].decode(), end + 1


def header_of(data):
    """The attributes as bytes, and where they end."""
    attributes, at = {}, 8
    while data[at]:
        name, at = text_at(data, at)
        _, at = text_at(data, at)
        (size,) = struct.unpack_from("<i", data, at)
        attributes[name] = data[at + 4:at + 4 + size]
        at += 4 + size
    return attributes, at + 1


def channels_in(attribute):
    """(name, dtype) in the order of the file."""
    channels, at = [], 0
    while attribute[at]:
        name, at = text_at(attribute, at)
        channels.append((name, KINDS[struct.unpack_from("<i", attribute, at)[0]]))
        at += 16
    return channels


def unzipped(chunk, size):
    if len(chunk) == size:
        return chunk
    steps = numpy.frombuffer(zlib.decompress(chunk), dtype="u1").astype("i8")
    steps[1:] -= 128
    mixed = (numpy.cumsum(steps) % 256).astype("u1")
    half = (size + 1) // 2
    plain = numpy.empty(size, dtype="u1")
    plain[0::2], plain[1::2] = mixed[:half], mixed[half:]
    return plain.tobytes()


def read(file):
    """Planes (height x width) by the channels' names."""
    with open(file, "rb") as opened:
        data = opened.read()
    attributes, at = header_of(data)
    compression = attributes["compression"][0]
    if compression not in LINES:
        raise ValueError("%s: compression %d; write it uncompressed or with ZIP" % (file, compression))
    left, top, right, bottom = struct.unpack("<4i", attributes["dataWindow"])
    width, height = right - left + 1, bottom - top + 1
    channels = channels_in(attributes["channels"])
    planes = {name: numpy.zeros((height, width), kind) for name, kind in channels}
    line_size = width * sum(kind.itemsize for _, kind in channels)
    lines = LINES[compression]
    for (start,) in struct.iter_unpack("<q", data[at:at + 8 * -(-height // lines)]):
        first, size = struct.unpack_from("<2i", data, start)
        rows = range(first - top, min(first - top + lines, height))
        chunk, place = unzipped(data[start + 8:start + 8 + size], len(rows) * line_size), 0
        for row in rows:
            for name, kind in channels:
                planes[name][row] = numpy.frombuffer(chunk, kind, width, place)
                place += width * kind.itemsize
    return planes


def color_of(planes, layer=""):
    """height x width x 3."""
    return numpy.dstack([planes[layer + channel] for channel in "RGB"]).astype(float)
