# SPDX-License-Identifier: Apache-2.0
"""The stubs say what the extension module has, and everything is documented."""

import ast
import inspect
import pathlib

import glint
from glint import _glint

PACKAGE = pathlib.Path(glint.__file__).parent


def parameters(function):
    """Names of a bound function's parameters, from the signature in its docstring."""
    call = function.__doc__.split("\n")[0].split(" -> ")[0]
    tree = ast.parse("def " + call.replace("*,", "*,") + ": ...").body[0].args
    return [a.arg for a in tree.posonlyargs + tree.args + tree.kwonlyargs]


def stubs():
    return ast.parse((PACKAGE / "_glint.pyi").read_text()).body


def stub_parameters(node):
    return [a.arg for a in node.args.args + node.args.kwonlyargs]


def test_every_name_is_in_the_stubs():
    known = {node.name for node in stubs() if isinstance(node, (ast.ClassDef, ast.FunctionDef))}
    known |= {node.target.id for node in stubs() if isinstance(node, ast.AnnAssign)}
    assert known == {name for name in vars(_glint) if not name.startswith("__")}


def test_functions_take_what_the_stubs_say():
    functions = [node for node in stubs() if isinstance(node, ast.FunctionDef)]
    assert len(functions) > 5
    for node in functions:
        assert parameters(getattr(_glint, node.name)) == stub_parameters(node), node.name


def test_methods_take_what_the_stubs_say():
    for node in stubs():
        if not isinstance(node, ast.ClassDef) or node.name.endswith("Error"):
            continue
        cls = getattr(_glint, node.name)
        methods = {part.name: part for part in node.body}
        public = {name for name in vars(cls) if not name.startswith("_")}
        assert public == {name for name in methods if not name.startswith("_")}
        for name in public:
            member = getattr(cls, name)
            if not isinstance(member, property):
                assert parameters(member) == stub_parameters(methods[name]), name


def test_the_package_says_that_it_has_types():
    assert (PACKAGE / "py.typed").exists()


def test_everything_public_is_documented():
    for name in glint.__all__:
        if name not in ("TRACK", "TRUTH"):
            assert inspect.getdoc(getattr(glint, name)), name
    for name, member in inspect.getmembers(glint.Engine):
        if not name.startswith("_"):
            assert inspect.getdoc(member), name
