"""The stub says what the module has: names, arguments and their defaults, texts, shapes, types, units, who may write."""
import ast
import os
import pathlib
import re
import unittest

import numpy as np
import sprung

TORUS = os.path.join(os.environ["SPRUNG_MODELS"], "torus.ply")
STUB = ast.parse(pathlib.Path(sprung.__file__).with_name("sprung.pyi").read_text())
UNITS = {"m", "s", "Hz", "N", "m/s", "kg", "kg/m3", "Pa", "1", "rows", "sRGB", "units"}


def defined(node):
    """What a class or the module of the stub defines, by name."""
    kinds = (ast.FunctionDef, ast.ClassDef)
    return {item.name: item for item in node.body if isinstance(item, kinds)}


def functions():
    """Each function of the stub: its name, its node, and the module's own."""
    for name, node in defined(STUB).items():
        if isinstance(node, ast.FunctionDef):
            yield name, node, getattr(sprung, name)
            continue
        for member, function in defined(node).items():
            yield f"{name}.{member}", function, getattr(getattr(sprung, name), member)


def words(text):
    return " ".join(text.split())


def split_arguments(text):
    """At the commas that no bracket encloses."""
    parts, depth = [""], 0
    for letter in text:
        depth += (letter in "([{") - (letter in ")]}")
        if letter == "," and depth == 0:
            parts.append("")
        else:
            parts[-1] += letter
    return [part.strip() for part in parts]


def signature_of(thing):
    """Arguments and defaults that pybind11 writes in the first line of a function's text: name to text, or None."""
    line = thing.__doc__.splitlines()[0]
    found = {}
    for part in split_arguments(line[line.index("(") + 1 : line.rindex(") ->")]):
        name, _, rest = part.partition(":")
        found[name] = rest.partition(" = ")[2] or None
    return found


class Stubs(unittest.TestCase):
    def test_every_name_is_in_both(self):
        public = {name for name in dir(sprung) if not name.startswith("_")}
        self.assertEqual(public, set(defined(STUB)))
        for name, node in defined(STUB).items():
            if isinstance(node, ast.ClassDef) and not issubclass(getattr(sprung, name), Exception):
                public = {member for member in dir(getattr(sprung, name)) if not member.startswith("_")}
                self.assertEqual(public, set(defined(node)) - {"__init__"}, name)

    def test_texts_are_the_same(self):
        for name, node, thing in functions():
            text = thing.__doc__ if isinstance(thing, property) else "\n".join(thing.__doc__.splitlines()[1:])
            self.assertEqual(words(text), words(ast.get_docstring(node) or ""), name)
        for name, node in defined(STUB).items():
            if isinstance(node, ast.ClassDef):
                self.assertEqual(words(getattr(sprung, name).__doc__), words(ast.get_docstring(node)), name)
        self.assertTrue(words(ast.get_docstring(STUB)).startswith(sprung.__doc__))

    def test_arguments_are_the_same(self):
        seen = 0
        for name, node, thing in functions():
            if isinstance(thing, property):
                continue
            names = [argument.arg for argument in node.args.args]
            defaults = [None] * (len(names) - len(node.args.defaults)) + node.args.defaults
            module = signature_of(thing)
            self.assertEqual([word for word in module if word and word != "**kwargs"], names, name)
            for argument, default in zip(names, defaults):
                own = None if default is None else ast.literal_eval(default)
                theirs = None if module[argument] is None else ast.literal_eval(module[argument])
                self.assertEqual(own, theirs, f"{name}, {argument}")
                seen += default is not None
        self.assertGreaterEqual(seen, 12)

    def test_every_quantity_has_a_unit(self):
        for name, node, _ in functions():
            returns = ast.unparse(node.returns)
            if returns != "float" and not returns.startswith("NDArray"):
                continue
            text = ast.get_docstring(node).split("; no copy")[0].split("; azimuth")[0]
            self.assertTrue(UNITS & set(re.split(r"[ ,;.)]+", text)), f"{name}: {text}")


class Arrays(unittest.TestCase):
    """What the stub says of an array against the array."""

    @classmethod
    def setUpClass(cls):
        world = sprung.World()
        mesh = sprung.read_mesh(TORUS)
        (body,) = world.add(mesh, sprung.material("gelatin"), size=0.1, bricks=8)
        cls.objects = {"World": world, "Mesh": mesh, "Body": body}
        cls.arguments = {"field": ["stress"], "render": [32, 24]}

    def arrays(self):
        """Every array that the stub knows: what it says, and how to get it."""
        for owner, thing in self.objects.items():
            for name, node in defined(defined(STUB)[owner]).items():
                returns = ast.unparse(node.returns)
                if returns.startswith("NDArray"):
                    is_property = any(ast.unparse(word) == "property" for word in node.decorator_list)
                    get = (lambda t=thing, n=name: getattr(t, n)) if is_property else (
                        lambda t=thing, n=name: getattr(t, n)(*self.arguments.get(n, [])))
                    yield owner, name, returns, ast.get_docstring(node), get

    def test_shapes_and_types(self):
        sizes = {("World", "height"): 24, ("World", "width"): 32}
        seen = 0
        for owner, name, returns, text, get in self.arrays():
            array = get()
            self.assertEqual(f"NDArray[np.{array.dtype}]", returns, name)
            shape = [word for word in re.match(r"\((.*?)\)", text)[1].split(",") if word]
            self.assertEqual(array.ndim, len(shape), name)
            for word, size in zip(shape, array.shape):
                known = int(word) if word.strip().isdigit() else sizes.setdefault((owner, word.strip()), size)
                self.assertEqual(size, known, f"{owner}.{name}: {word}")
            seen += 1
        self.assertEqual(seen, 13)
        self.assertEqual(len({sizes["Body", letter] for letter in "mnvt"}), 4)

    def test_copies_and_who_may_write(self):
        for owner, name, _, text, get in self.arrays():
            array = get()
            self.assertEqual(np.shares_memory(array, get()), "no copy" in text, name)
            self.assertEqual(array.flags.writeable, "read only" not in text, name)


if __name__ == "__main__":
    unittest.main()
