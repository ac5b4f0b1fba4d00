"""sprung's tone curve, as in render/shaders/picture.glsl."""
import numpy

SHOULDER = 0.8 - 0.02
DESATURATION = 0.15


def toned(light):
    low = light.min(axis=-1, keepdims=True)
    color = light - numpy.where(low < 0.04, low - 12.5 * low * low, 0.02)
    peak = color.max(axis=-1, keepdims=True)
    above = numpy.maximum(peak, SHOULDER)
    room = 1 - SHOULDER
    new_peak = 1 - room * room / (above + room - SHOULDER)
    grey = 1 - 1 / (DESATURATION * (above - new_peak) + 1)
    bright = color * new_peak / above
    return numpy.where(peak < SHOULDER, color, bright + grey * (new_peak - bright))


def picture(light):
    """Levels of 0 to 255, not rounded, of linear light (height x width x 3)."""
    color = numpy.clip(toned(light), 0, None)
    srgb = numpy.where(color <= 0.0031308, 12.92 * color, 1.055 * numpy.maximum(color, 1e-9) ** (1 / 2.4) - 0.055)
    return 255 * numpy.clip(srgb, 0, 1)
