# SPDX-License-Identifier: BSD-3-Clause
"""Types and keywords: stubs against the module, against the program's tables, and in use; examples in docstrings."""
import ast
import doctest
import inspect
import os
import pathlib
import re
import subprocess
import sys

import pytest
import warren

PACKAGE = pathlib.Path(warren.__file__).parent
LIMITS = {"threads", "budget", "memory", "progress"}
# What is no option of a call: outputs and how the terminal looks.
OUTPUTS = {"json", "picture", "figures", "table", "path", "every", "speed", "acceleration", "lateral_acceleration", "joint_speed",
           "joint_acceleration", "frame", "save_roadmap", "quiet", "color", "trace", "help", "output", "no_world", "csv",
           "runs", "log", "pictures", "batch", "lengths_only", "matrix", "world", "keep", "animate",
           "curves", "title", "dpi", "size", "show", "heading", "html", "no_path", "resume",
           "certificate"}
# Other words for options, and for one that is a word of Python's.
OTHERS = {"goals", "tolerance", "region", "return_", "hole", "certificate"}


def keywords_of_stub(name):
    for file in PACKAGE.glob("*.pyi"):
        for node in ast.walk(ast.parse(file.read_text())):
            if isinstance(node, ast.FunctionDef) and node.name == name:
                arguments = node.args
                return {a.arg for a in arguments.args + arguments.kwonlyargs} - {"self"}
    raise AssertionError(name)


@pytest.mark.parametrize("name, verb, other, without", [
    ("solve", "solve", {"world", "keep", "on_improvement"} | OTHERS, {"map_rules", "request", "return"}),
    ("verify", "verify", {"world", "path"} | OTHERS, {"map_rules", "request", "return"}),
    ("build", "build", {"world"}, {"map_rules", "request"}),
    ("query", "query", {"keep"}, {"map_rules", "request"}),
    ("lengths", "query", {"starts", "goals"}, {"map_rules", "request", "start", "goal", "explain", "bound"}),
    ("compare", "compare", {"world"}, {"map_rules", "request"}),
])
def test_the_keywords_are_the_long_options_of_the_program(program, name, verb, other, without):
    theirs = set(program.help_options(verb)) - OUTPUTS - without
    assert keywords_of_stub(name) - other == theirs | LIMITS


def test_the_choices_of_a_stub_are_those_of_the_program(program):
    stub = (PACKAGE / "_worlds.pyi").read_text() + (PACKAGE / "_solving.pyi").read_text()
    for name, (_, choices) in program.help_options("solve").items():
        if name in OUTPUTS | LIMITS | {"map_rules", "request"} or not choices:
            continue
        assert ", ".join(f'"{choice}"' for choice in choices) in stub, name


def test_the_algorithms_of_mazes_are_those_of_the_library():
    with pytest.raises(warren.UsageError) as caught:
        warren.maze(5, 5, algorithm="nope")
    names = caught.value.what.split(" one of ")[1].split(", ")
    literal = "Literal[" + ", ".join(f'"{name}"' for name in names) + "]"
    assert literal in (PACKAGE / "_making_worlds.pyi").read_text()
    assert "{" + ", ".join(f"'{name}'" for name in names) + "}" in warren.maze.__doc__


def test_every_option_is_documented():
    for function in (warren.solve, warren.build, warren.compare, warren.verify, warren.read_world, warren.Roadmap.query,
                     warren.Answer.save_path):
        for keyword in keywords_of_stub(function.__name__) - {"self"}:
            assert keyword in function.__doc__, (function, keyword)
        assert "{options}" not in function.__doc__ and not re.search(" --[a-z]", function.__doc__)


def test_every_public_name_is_documented():
    for name in warren.__all__:
        thing = getattr(warren, name)
        assert thing.__doc__, name
        if not inspect.isclass(thing):
            continue
        for member, value in vars(thing).items():
            if not member.startswith("_") and (callable(value) or isinstance(value, property)):
                assert inspect.getdoc(value), f"{name}.{member}"


def objects_with_examples():
    for name in ["warren", *warren.__all__]:
        thing = sys.modules["warren"] if name == "warren" else getattr(warren, name)
        if inspect.isroutine(thing) or inspect.isclass(thing) or name == "warren":
            yield name, thing


def test_the_examples_of_docstrings_say_what_happens():
    finder = doctest.DocTestFinder(recurse=False)
    runner = doctest.DocTestRunner(verbose=False)
    for name, thing in objects_with_examples():
        members = [(name, thing)]
        if inspect.isclass(thing):
            members += [(f"{name}.{key}", getattr(value, "fget", value)) for key, value in vars(thing).items()
                        if not key.startswith("_") and (inspect.isfunction(value) or isinstance(value, property))]
        for called, member in members:
            for example in finder.find(member, called, module=False, globs={}):
                runner.run(example)
    failed, tried = runner.summarize()
    assert failed == 0 and tried > 60


def mypy(*words):
    done = subprocess.run([sys.executable, "-B", "-m", *words], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          env={**os.environ, "MYPYPATH": str(PACKAGE.parent)})
    return done.returncode, done.stdout


@pytest.fixture(scope="module")
def cache(tmp_path_factory):
    return tmp_path_factory.mktemp("cache")


def test_stubtest_finds_no_difference(tmp_path, cache):
    (tmp_path / "mypy.ini").write_text(f"[mypy]\ncache_dir = {cache}\n")
    code, said = mypy("mypy.stubtest", "warren", "--mypy-config-file", str(tmp_path / "mypy.ini"))
    assert code == 0, said


def test_typed_programs_pass_mypy_strict(tmp_path, cache):
    program = pathlib.Path(__file__).with_name("typed_program.py")
    code, said = mypy("mypy", "--strict", "--cache-dir", str(cache), str(program))
    assert code == 0, said
    wrong = tmp_path / "wrong.py"
    wrong.write_text("import warren\nwarren.solve('maze:5x5', planner='prn')\nwarren.solve('maze:5x5').lenght\n")
    code, said = mypy("mypy", "--strict", "--cache-dir", str(cache), str(wrong))
    assert code == 1 and said.count("error:") == 2, said
