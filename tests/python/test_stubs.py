"""The stubs, the docstrings and the module say the same."""

import ast
import re
import unittest
from pathlib import Path

import faceprobe as fp
from faceprobe import _faceprobe

PACKAGE = Path(fp.__file__).parent
STUB = ast.parse((PACKAGE / "_faceprobe.pyi").read_text())


def public(names):
    return {name for name in names if not name.startswith("_")}


def is_function(node):
    return isinstance(node, ast.FunctionDef)


def arguments_in_stub(node):
    """name -> default as text, or None."""
    positional = node.args.args
    defaults = [None] * (len(positional) - len(node.args.defaults)) + node.args.defaults
    found = dict(zip((a.arg for a in positional), defaults))
    found.update(zip((a.arg for a in node.args.kwonlyargs), node.args.kw_defaults))
    found.pop("self", None)
    return {name: None if value is None else ast.literal_eval(value) for name, value in found.items()}


def arguments_in_module(function):
    """As above, from the first line of a docstring: name(a: type = default, ...) -> type."""
    inside = re.match(r"\w+\((.*)\) -> ", function.__doc__).group(1)
    return arguments_in_stub(ast.parse("def f(" + inside + "): ...").body[0])


class Stubs(unittest.TestCase):
    def setUp(self):
        self.classes = {node.name: node for node in STUB.body if isinstance(node, ast.ClassDef)}
        self.functions = {node.name: node for node in STUB.body if is_function(node)}

    def test_the_package_exports_what_the_module_has(self):
        self.assertEqual(set(fp.__all__) - {"__version__"}, public(vars(_faceprobe)))
        self.assertEqual(public(vars(_faceprobe)), set(self.classes) | set(self.functions))
        self.assertTrue(all(getattr(fp, name) is getattr(_faceprobe, name) for name in fp.__all__))
        self.assertRegex(fp.__version__, r"^\d+\.\d+\.\d+$")
        self.assertTrue((PACKAGE / "py.typed").is_file())

    def test_classes_have_the_same_members_and_bases(self):
        for name, node in self.classes.items():
            found = getattr(_faceprobe, name)
            with self.subTest(name=name):
                fields = {item.target.id for item in node.body if isinstance(item, ast.AnnAssign)}
                methods = {item.name for item in node.body if is_function(item)}
                own = public(vars(found)) if node.name == "FaceprobeError" or not issubclass(found, Exception) else set()
                self.assertEqual(public(methods | fields), own)
                for item in filter(is_function, node.body):
                    is_property = any(getattr(d, "id", "") == "property" for d in item.decorator_list)
                    self.assertEqual(is_property, isinstance(vars(found).get(item.name), property), item.name)
                for base in node.bases:
                    if base.id in self.classes:
                        self.assertTrue(issubclass(found, getattr(_faceprobe, base.id)))

    def test_arguments_and_defaults_are_the_same(self):
        pairs = [(node, getattr(_faceprobe, name)) for name, node in self.functions.items()]
        for name, node in self.classes.items():
            for item in filter(is_function, node.body):
                if not item.decorator_list:
                    pairs.append((item, getattr(getattr(_faceprobe, name), item.name)))
        self.assertGreater(len(pairs), 10)
        for node, function in pairs:
            with self.subTest(name=node.name):
                stub, module = arguments_in_stub(node), arguments_in_module(function)
                self.assertEqual(list(stub), list(module))
                for name, value in stub.items():
                    if isinstance(value, float):
                        self.assertAlmostEqual(module[name], value, places=6)
                    else:
                        self.assertEqual(module[name], value, name)

    def test_everything_says_what_it_is(self):
        for name in public(fp.__all__):
            self.assertTrue(getattr(fp, name).__doc__, name)
        for name in self.classes:
            for member, value in vars(getattr(_faceprobe, name)).items():
                if not member.startswith("_") and (callable(value) or isinstance(value, property)):
                    self.assertTrue(value.__doc__ and len(value.__doc__) > 5, name + "." + member)
        self.assertIn("import faceprobe as fp", fp.__doc__)

    def test_types_go_by_the_packages_name(self):
        for name in self.classes:
            self.assertEqual(getattr(fp, name).__module__, "faceprobe")


if __name__ == "__main__":
    unittest.main()
