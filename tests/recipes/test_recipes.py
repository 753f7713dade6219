#!/usr/bin/env python3
"""Each recipe of this folder, NAME.diff, applies to the sources, and what it touches compiles; README.md has them.

    test_recipes.py                                      applies each to copies of the files that it touches
    test_recipes.py --build build/release                then all to one copy, and looks at what they touch, and at
                                                         what loops over it, by that build's compiler and flags
    test_recipes.py --build build/release --each         at each by itself, which takes minutes
    test_recipes.py --build build/release NAME...        at these by themselves

Nothing is built; with --tamp PROGRAM that runs the recipe of a verification. What fails is told with file and line."""

import argparse
import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
RECIPES = {path.stem: path for path in sorted(pathlib.Path(__file__).parent.glob("*.diff"))}

# Sources that loop over the list in which a recipe enters something.
LOOPS = {
    "interpolator": ["components/shapes/interpolation.cpp"],
    "material": ["tools/scene/materials/read_material.cpp"],
    "modulus": ["components/materials/tabular_cap.cpp", "tools/scene/materials/read_modulus.cpp"],
    "scene_key": ["tools/scene/keys/scene_keys.cpp"],
}
# A header, and what holds there once the recipe has entered something.
ENTERED = {
    "interpolator": ("components/shapes/interpolator.hpp",
                     "std::is_constructible_v<components::Shapes<2>, components::NarrowGimp<2>>"),
    "material": ("components/materials/material_model.hpp",
                 "std::is_constructible_v<components::MaterialModel, components::Fluid>"),
    "modulus": ("components/moduli/modulus.hpp",
                "std::is_constructible_v<components::Modulus, components::ConstantModulus>"),
    "monitor": ("tasks/scene_limits.hpp", "tasks::SceneLimits{}.split_updates > 0"),
    "scene_key": ("tasks/scene_time.hpp", 'tasks::SceneTime::parameters().back().key == "growth"'),
    "transfer": ("components/transfers/transfers.hpp",
                 "std::is_constructible_v<components::Transfers, components::Aflip>"),
}
# Of the flags of a build those that say how to read a source; nothing that is precompiled.
KEPT = re.compile(r"-(D|I|O|g|m|W(?!invalid-pch)|std=|f(?!pch))")


class Failure(Exception):
    pass


def touched(name):
    """The files of a recipe, and those of them that it makes."""
    text = RECIPES[name].read_text()
    return re.findall(r"^\+\+\+ b/(.*)$", text, re.M), re.findall(r"^--- /dev/null\n\+\+\+ b/(.*)$", text, re.M)


def apply(name, overlay):
    """Changes the files of the recipe in `overlay`, into which they are copied first where they are not there yet."""
    files, made = touched(name)
    for file in files:
        copy = overlay / file
        copy.parent.mkdir(parents=True, exist_ok=True)
        if file in made and (ROOT / file).exists():
            raise Failure(f"tests/recipes/{name}.diff makes {file}, which is there")
        if file not in made and not (ROOT / file).exists():
            raise Failure(f"tests/recipes/{name}.diff changes {file}, which is not there")
        if file not in made and not copy.exists():
            copy.write_bytes((ROOT / file).read_bytes())
    # Within a repository git would pass over files that are not its own.
    done = subprocess.run(["git", "apply", "--verbose", str(RECIPES[name])], cwd=overlay, capture_output=True,
                          text=True, env={**os.environ, "GIT_CEILING_DIRECTORIES": str(overlay.parent)})
    if done.returncode != 0:
        raise Failure(f"tests/recipes/{name}.diff does not apply:\n{done.stderr.strip()}")


class Compiler:
    """That of a build, with the flags of the tools, which see the headers of all rooms."""

    def __init__(self, build):
        cache = (build / "CMakeCache.txt").read_text()
        self.program = re.search(r"^CMAKE_CXX_COMPILER:\w+=(.*)$", cache, re.M)[1]
        entries = json.loads((build / "compile_commands.json").read_text())
        words = next(shlex.split(entry["command"]) for entry in entries if "/tamp_tools.dir/" in entry["command"])
        self.flags = []
        for word, following in zip(words, [*words[1:], ""]):
            if KEPT.match(word):
                self.flags.append(word)
            elif word == "-isystem":
                self.flags += [word, following]

    def errors(self, lines, overlay):
        """What is wrong with a source of these lines, with its places; nothing where all is well."""
        source = overlay / "recipes.cpp"
        source.write_text("\n".join(lines) + "\n")
        look = [self.program, "-fsyntax-only", "-fmax-errors=3", f"-I{overlay}", f"-I{ROOT}"]
        done = subprocess.run([*look, *self.flags, str(source)], capture_output=True, text=True)
        text = done.stderr.replace(f"{overlay}/", "").replace(f"{ROOT}/", "")
        return "" if done.returncode == 0 else text or f"{self.program} ended with {done.returncode}"


def sources(names):
    """What to look at, by room and folder."""
    rooms = {}
    for name in names:
        for file in [*touched(name)[0], *LOOPS.get(name, [])]:
            if file.endswith(".cpp"):
                room, folder = file.split("/")[0], file.rpartition("/")[0]
                rooms.setdefault(room, {}).setdefault(folder, {})[f'#include "{file}"'] = None
    return rooms


def entered(names):
    """Asks for what these recipes have entered."""
    lines = ["#include <type_traits>"]
    for name in [name for name in names if name in ENTERED]:
        header, holds = ENTERED[name]
        lines += [f'#include "{header}"', f'#line 1 "tests/recipes/{name}.diff"',
                  f'namespace tamp {{ static_assert({holds}, "entered in its list"); }}']
    return lines


def look_at(names, compiler, overlay):
    """A room as one, as what it includes takes the time; where that fails, folder by folder: beyond those names in
    unnamed namespaces may be the same."""
    found = []
    rooms = [[*folders.values(), []] for folders in sources(names).values()] or [[[]]]
    rooms[-1][-1] = entered(names)
    for parts in rooms:
        if compiler.errors([line for lines in parts for line in lines], overlay):
            found += [compiler.errors(lines, overlay) for lines in parts]
    text = "\n".join(part for part in found if part)
    if text:
        raise Failure(f"{', '.join(names)}: does not compile\n{text}")


def run_verification(program, overlay):
    study = overlay / "inputs/verification/free_fall.json"
    results = overlay / "results"
    done = subprocess.run([program, "study", study, "--short", "--quiet", "--out", results], capture_output=True,
                          text=True)
    if done.returncode != 0:
        raise Failure(f"verification: exit code {done.returncode}\n{done.stderr}")
    gates = json.loads((results / "study.json").read_text())["gates"]
    if not gates or not all(gate["holds"] for gate in gates):
        raise Failure(f"verification: not all holds that is expected: {gates}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME", help=", ".join(RECIPES))
    parser.add_argument("--build", type=pathlib.Path, help="a folder with a CMakeCache.txt")
    parser.add_argument("--tamp", type=pathlib.Path, help="the program")
    parser.add_argument("--each", action="store_true", help="each recipe by itself")
    options = parser.parse_args()
    unknown = set(options.names) - set(RECIPES)
    if unknown:
        parser.error(f"no recipe {', '.join(sorted(unknown))}; expected some of {', '.join(RECIPES)}")
    if shutil.which("git") is None:
        print("no git, by which diffs are applied")
        return 77
    page = (ROOT / "tests/recipes/README.md").read_text()
    failures = [f"tests/recipes/README.md does not link to {name}.diff" for name in RECIPES
                if f"]({name}.diff)" not in page]

    def fits(names, check):
        with tempfile.TemporaryDirectory() as folder:
            overlay = pathlib.Path(folder).resolve()
            try:
                for name in names:
                    apply(name, overlay)
                check(overlay)
            except Failure as failure:
                failures.append(str(failure))
                return False
        return True

    def check_of(name):
        runs = options.tamp and name == "verification"
        return lambda overlay: run_verification(options.tamp.resolve(), overlay) if runs else None

    names = [name for name in options.names or RECIPES if fits([name], check_of(name))]
    if options.build:
        compiler = Compiler(options.build)
        for group in [[name] for name in names] if options.each or options.names else [names]:
            fits(group, lambda overlay: look_at(group, compiler, overlay))
    print("\n".join(failures) or f"{len(names)} recipes fit: {', '.join(names)}")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
