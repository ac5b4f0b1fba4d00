"""Pictures of one frame by several programs, as levels of 0 to 255 (height x width x 3), with processor seconds."""
import json
import os
import pathlib
import shutil
import subprocess

import matplotlib.image
import numpy

import exr
import tone_curve

HERE = pathlib.Path(__file__).resolve().parent
EEVEE_SAMPLES = 16


class NotAvailable(Exception):
    pass


def call(command):
    """Processor seconds, also of what the program starts."""
    before = os.times()
    done = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    after = os.times()
    if done.returncode:
        lines = [line for line in done.stdout.splitlines() if line.strip() and not line.startswith("Fra:")]
        raise NotAvailable("%s: %s" % (command[0], " / ".join(lines[-3:]) or "exit code %d" % done.returncode))
    return after.children_user + after.children_system - before.children_user - before.children_system


def require(programs, remedy):
    absent = [str(program) for program in programs if not shutil.which(str(program))]
    if absent:
        raise NotAvailable("%s not found: %s" % (", ".join(absent), remedy))


def read_png(file):
    return 255.0 * matplotlib.image.imread(file)[..., :3]


def write_png(levels, file):
    matplotlib.image.imsave(file, numpy.clip(levels / 255, 0, 1))


def numbers_in(plane):
    return plane.round().astype(int)


class Frame:
    """`given`: the arguments of run."""

    def __init__(self, given):
        self.given = given
        self.size = [int(side) for side in given.size.split("x")]
        self.sprung_program = given.build / "sprung"
        describe = given.build / "describe_stage"
        require([self.sprung_program, describe], "ninja -C %s sprung describe_stage" % given.build)
        self.stage_folder = given.out / "stage"
        call([describe, given.film, given.frame] + self.size + [self.stage_folder])
        self.stage = json.loads((self.stage_folder / "stage.json").read_text())

    def file(self, name):
        return self.given.out / name

    def render(self, quality, file):
        return call([self.sprung_program, "render", self.given.film, "--frame", self.given.frame, "--quality", quality,
                     "--resolution", "%dx%d" % tuple(self.size), "--overwrite", "--quiet", "-o", file])

    def sprung(self, quality):
        file = self.file(quality + ".png")
        seconds = self.render(quality, file)
        return read_png(file), seconds

    def passes(self):
        """Linear light and the numbers of the bodies, in default quality."""
        file = self.file("passes.exr")
        self.render("default", file)
        planes = exr.read(file)
        return exr.color_of(planes), numbers_in(planes["IndexOB.X"])

    def blender(self, engine, file, samples, seed=0):
        require(["blender"], "install Debian's package blender")
        command = ["blender", "-b", "--factory-startup", "-noaudio", "--python-exit-code", "1",
                   "-P", HERE / "cycles.py", "--", self.stage_folder, file, engine, "--samples", samples,
                   "--size", *self.size, "--seed", seed, "--surface", self.given.surface,
                   "--inside", self.given.inside, "--threads", self.given.threads]
        return call((["xvfb-run", "-a"] if engine == "BLENDER_EEVEE" else []) + command)

    def cycles(self):
        """Also half the difference of the two pictures it is the mean of, and the numbers of bodies."""
        seconds, halves = 0, []
        for seed in (0, 1):
            file = self.file("cycles_%d.exr" % seed)
            if not (self.given.keep and file.exists()):
                seconds += self.blender("CYCLES", file, max(self.given.samples // 2, 1), seed)
            planes = exr.read(file)
            halves.append(exr.color_of(planes, "ViewLayer.Combined."))
        picture = tone_curve.picture((halves[0] + halves[1]) / 2)
        write_png(picture, self.file("cycles.png"))
        noise = (tone_curve.picture(halves[0]) - tone_curve.picture(halves[1])) / 2
        return picture, noise, numbers_in(planes["ViewLayer.IndexOB.X"]), seconds

    def eevee(self):
        require(["xvfb-run", "xauth"], "install Debian's packages xvfb and xauth")
        file = self.file("eevee.exr")
        seconds = self.blender("BLENDER_EEVEE", file, EEVEE_SAMPLES)
        picture = tone_curve.picture(exr.color_of(exr.read(file), "ViewLayer.Combined."))
        write_png(picture, self.file("eevee.png"))
        return picture, seconds

    def f3d(self):
        """The exported bodies with F3D's own light: what a viewer of models shows."""
        require(["f3d", "xvfb-run", "xauth"], "install Debian's packages f3d, xvfb and xauth")
        model, file = self.file("bodies.glb"), self.file("f3d.png")
        call([self.sprung_program, "export", self.given.film, "--frames", "%d:%d" % (2 * (self.given.frame,)),
              "--overwrite", "--quiet", "-o", model])
        camera = self.stage["camera"]
        command = ["xvfb-run", "-a", "f3d", "--dry-run", model, "--output", file,
                   "--resolution=%d,%d" % tuple(self.size),
                   "--camera-view-angle=%g" % camera["vertical_field_of_view"]]
        for option, key in (("position", "eye"), ("focal-point", "target"), ("view-up", "up")):
            command.append("--camera-%s=%s" % (option, ",".join("%.9g" % x for x in camera[key])))
        seconds = call(command)
        return read_png(file), seconds
