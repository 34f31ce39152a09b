#!/usr/bin/env python3
"""Checks from the #include lines that knowledge points one way (docs/architecture.md).

  check_dependencies.py [ROOT]       checks the tree, names every offending line, exit code 1 if there is one
  check_dependencies.py --dot        prints docs/draw/rooms.dot: who includes whom, but for what follows from others
  check_dependencies.py --drawn      whether that file and docs/rooms.svg still say so
  check_dependencies.py --self-test  checks the checker on a small tree with planted offences
"""
import html
import pathlib
import re
import sys
import tempfile

FOLDERS = ("kernels", "messages", "components", "scenarios", "launch", "tools", "tests", "bench", "examples")
INCLUDE = re.compile(r'^\s*#\s*include\s*(?:"([^"]+)"|<([^>]+)>)')

# Numeric libraries that kernels may use.
NUMERIC = re.compile(r"^(Eigen/|tbb/|embree3/|OpenMesh/|GeographicLib/|Random123/|fftw3\.h$|png\.h$|[a-z]+intrin\.h$)")
STANDARD = re.compile(r"^[a-z0-9_]+$")  # <vector>, <cstdint>
TEST_FRAMEWORK = re.compile(r"^catch2/")

# Heavy libraries: (name, header pattern, where it may be included, what is allowed in words).
HEAVY = (
    ("msgpack", r"^msgpack", r"^messages/.*\.cpp$", "messages/*.cpp"),
    ("yaml-cpp", r"^yaml-cpp/", r"^components/config/", "components/config"),
    ("ZeroMQ", r"^zmq", r"^(components/runtime/bus|bench|tests)/", "components/runtime/bus, bench, tests"),
    ("Embree", r"^embree\d/", r"^kernels/acoustics/trace/", "kernels/acoustics/trace"),
    ("OpenMesh", r"^OpenMesh/", r"^kernels/mesh/progressive/", "kernels/mesh/progressive"),
    ("GDAL", r"^(gdal|ogr|cpl|vrt)\w*\.h", r"^(components/terrain|components/terrain_pager|tools)/",
     "components/terrain, components/terrain_pager, tools"),
    ("Assimp", r"^assimp/", r"^components/terrain/", "components/terrain"),
    ("OpenSSL", r"^openssl/", r"^components/terrain/tiles/", "components/terrain/tiles"),
    ("Boost", r"^boost/", r"^tools/console/server/", "tools/console/server"),
    ("nlohmann/json", r"^nlohmann/json\.hpp", r"\.cpp$", ".cpp files (headers take <nlohmann/json_fwd.hpp>)"),
)

# What each room sees besides itself; the longest name that fits a file counts. Rooms named after a process (the last
# line of components) see the shared rooms and never each other.
KERNELS = ["kernels"]
TALK = ["messages", "components/errors", "components/runtime"]
FILES = ["components/errors", "components/config"]
WORLD = FILES + ["scenarios", "messages"] + KERNELS
SHARED = TALK + WORLD + ["components/record", "components/formats", "components/transport", "components/feeds", "components/terrain",
                                            "components/sonar", "components/survey_files", "components/tracks", "components/truth", "components/view"]
SEES = {
    "kernels/base": [],
    "kernels/water": ["kernels/base"],
    "kernels/seabed": ["kernels/base"],
    "kernels/mesh": ["kernels/base"],
    "kernels/vehicle": ["kernels/base"],
    "kernels/instruments": ["kernels/base"],
    "kernels/acoustics": ["kernels/base", "kernels/water", "kernels/seabed", "kernels/mesh"],
    "kernels/survey": ["kernels/base", "kernels/water", "kernels/seabed", "kernels/vehicle"],
    "kernels": [],
    "messages": [],
    "components/errors": [],
    "components/formats": ["components/errors"],
    "components/survey_files": ["components/errors", "components/formats", "components/runtime/tool.h"] + KERNELS,
    "components/tracks": TALK + WORLD + ["components/formats", "components/record", "components/survey_files"],
    "components/transport": ["components/errors"],
    "components/feeds": TALK + FILES + ["components/formats", "components/transport"],
    "components/config": ["components/errors"],
    "components/runtime": ["messages", "components/errors"],
    "components/record": TALK,
    "components/view": ["messages", "kernels/base"],
    "components/truth": TALK + KERNELS,
    "components/terrain": WORLD,
    "components/sonar": TALK + WORLD + ["components/view", "components/terrain/mesh_message.h", "components/terrain/object_message.h"],
    "components": SHARED + ["launch/file", "launch/process"],
    "scenarios": WORLD,
    "launch/file": TALK + FILES + ["scenarios/scenario_file.h", "kernels/base/isa"],
    "launch/process": TALK + FILES + ["scenarios/scenario_file.h", "launch/file", "kernels/base/profile", "kernels/base/isa"],
    "launch/dataset": TALK + FILES + ["scenarios/scenario_file.h", "launch/file", "launch/batch", "launch/child.h", "launch/report.h", "kernels/base/random"],
    "launch": SHARED,
    "tools": SHARED + ["launch"],
}


# What these folders must not reach, whatever they include: a newcomer's component links no ocean.
FAR = {"examples/gyro": re.compile(r"^(scenarios/world|components/sonar|kernels/(?!base))/")}

# Rooms of the picture: the first prefix that fits.
DRAWN = (
    ("tools/", "tools/<verb>"), ("launch/", "launch"), ("scenarios/", "scenarios"), ("messages/", "messages"), ("kernels/", "kernels"),
    *((f"components/{room}/", f"components/{room}") for room in ("sonar", "terrain", "record", "formats", "survey_files", "tracks", "feeds", "transport", "truth", "view", "config", "runtime", "errors")),
    ("components/", "components/<process>"),
)
# Every process has its main() from there; drawn, it would be an arrow both ways.
HOSTS = ("launch/process/", "launch/file/")


def is_test(path):
    return path.endswith("_test.cpp")


def is_bench(path):
    return path.endswith("bench.cpp")


def visible_folders(path):
    """The folders whose headers the file may include; None: no restriction."""
    parts = path.split("/")
    if parts[0] in ("tests", "bench", "examples"):
        return None
    room = max((r for r in SEES if path.startswith(r + "/")), key=len)
    own = "/".join(parts[:2]) if room in ("components", "tools") and len(parts) > 2 else room
    seen = [own] + SEES[room]
    if is_test(path) or is_bench(path) or "/testing/" in path:
        seen += ["tests/support"] + (["kernels"] if parts[0] == "kernels" else []) + (["scenarios"] if parts[0] == "launch" else [])
    return seen


def problem_of_project_include(root, path, target):
    if not (root / target).is_file() and not (root / f"{target}.in").is_file():  # configured by CMake
        return f'"{target}" does not exist (includes are written from the repository root)'
    seen = visible_folders(path)
    if seen is not None and not any(target == folder or target.startswith(folder + "/") for folder in seen):
        return f'"{target}" is out of sight here; visible: {", ".join(seen)}'
    return None


def problem_of_library_include(path, target):
    for name, pattern, where, words in HEAVY:
        if re.match(pattern, target) and not re.search(where, path):
            return f"<{target}>: {name} belongs to {words}"
    if STANDARD.match(target) or (is_test(path) and TEST_FRAMEWORK.match(target)):
        return None
    area = path.split("/")[0]
    if is_bench(path) and target.startswith("benchmark/"):
        return None
    if area == "kernels" and not NUMERIC.match(target) and not is_test(path):
        return f"<{target}>: kernels see the standard library and numeric libraries only"
    if area == "messages" and not is_test(path) and not re.match(r"^(msgpack|nlohmann/)", target):
        return f"<{target}>: messages see the standard library only (and codecs msgpack and JSON)"
    return None


def includes_of(root):
    """File -> the project's files that it includes."""
    sources = sorted(p for f in FOLDERS for p in (root / f).rglob("*") if p.suffix in (".h", ".cpp"))
    included = {}
    for source in sources:
        lines = map(INCLUDE.match, source.read_text(encoding="utf-8").splitlines())
        included[source.relative_to(root).as_posix()] = [match[1] for match in lines if match and match[1]]
    return included


def far_includes(included):
    """What the folders of FAR reach and must not, with the way there."""
    found = []
    for folder, forbidden in FAR.items():
        ways = {path: path for path in included if path.startswith(folder + "/") and not is_test(path)}
        due = list(ways)
        while due:
            path = due.pop()
            for target in included.get(path, []):
                if target in ways:
                    continue
                ways[target] = f"{ways[path]} -> {target}"
                due.append(target)
                if forbidden.match(target):
                    found.append(f"{folder}: reaches {target}: {ways[target]}")
    return found


def room_drawn(path):
    return next((name for prefix, name in DRAWN if path.startswith(prefix)), None)


def dot(included):
    """The rooms and their arrows, as text for Graphviz. An arrow that follows from others is left out."""
    arrows = {}
    for path, targets in included.items():
        if is_test(path) or is_bench(path) or "/testing/" in path or room_drawn(path) is None:
            continue
        for target in targets:
            room, other = room_drawn(path), room_drawn(target)
            if other not in (None, room) and not (room.startswith("components/") and target.startswith(HOSTS)):
                arrows.setdefault(room, set()).add(other)

    def reached(room, without):
        due, seen = [other for other in arrows.get(room, ()) if other != without], set()
        while due:
            other = due.pop()
            if other not in seen:
                seen.add(other)
                due += arrows.get(other, ())
        return seen

    kept = [(room, other) for room in sorted(arrows) for other in sorted(arrows[room]) if other not in reached(room, other)]
    return "\n".join([
        "// The rooms: who sees whom. Written by cmake/check_dependencies.py --dot; docs/rooms.svg is drawn from it with dot -Tsvg.",
        "digraph rooms {",
        '  rankdir=TB; node [shape=box, style="rounded", fontname="sans-serif", fontsize=12]; edge [arrowsize=0.7];',
        *(f'  "{room}" -> "{other}";' for room, other in kept), "}"])


def drawn(root):
    """What docs/draw/rooms.dot and docs/rooms.svg say otherwise than the include lines."""
    text = dot(includes_of(root)) + "\n"
    arrows = {f"{room}->{other}" for room, other in re.findall(r'"(.+)" -> "(.+)";', text)}
    picture = html.unescape((root / "docs/rooms.svg").read_text(encoding="utf-8"))
    wrong = [] if (root / "docs/draw/rooms.dot").read_text(encoding="utf-8") == text else ["docs/draw/rooms.dot"]
    wrong += [] if set(re.findall(r"<title>(.+->.+)</title>", picture)) == arrows else ["docs/rooms.svg"]
    return [f"{file}: is not of these includes: cmake/check_dependencies.py --dot > docs/draw/rooms.dot && "
            "dot -Tsvg docs/draw/rooms.dot -o docs/rooms.svg" for file in wrong]


def problems(root):
    """Every offending include line, as text."""
    found = far_includes(includes_of(root))
    sources = sorted(p for f in FOLDERS for p in (root / f).rglob("*") if p.suffix in (".h", ".cpp"))
    for source in sources:
        path = source.relative_to(root).as_posix()
        for number, line in enumerate(source.read_text(encoding="utf-8").splitlines(), 1):
            match = INCLUDE.match(line)
            if not match:
                continue
            quoted, angled = match.groups()
            problem = problem_of_project_include(root, path, quoted) if quoted else problem_of_library_include(path, angled)
            if problem:
                found.append(f"{path}:{number}: {problem}")
    return found, len(sources)


# A small tree: path -> include lines, each with the words its problem must hold, or None when it is fine.
PLANTED = {
    "kernels/a/a.h": [("<vector>", None), ("<Eigen/Core>", None), ('"messages/m.h"', "out of sight"),
                      ("<sys/socket.h>", "numeric libraries only"), ("<embree3/rtcore.h>", "kernels/acoustics/trace")],
    "kernels/a/bench.cpp": [("<benchmark/benchmark.h>", None), ('"tests/support/s.h"', None)],
    "kernels/a/a_test.cpp": [("<catch2/catch.hpp>", None), ('"kernels/a/a.h"', None), ('"a.h"', "does not exist")],
    "kernels/acoustics/trace/t.cpp": [("<embree3/rtcore.h>", None)],
    "messages/m.h": [("<cstdint>", None), ("<msgpack.hpp>", "messages/*.cpp"), ('"kernels/a/a.h"', "out of sight")],
    "messages/m.cpp": [("<msgpack.hpp>", None), ('"messages/m.h"', None), ("<fmt/core.h>", "standard library only")],
    "components/runtime/bus/z.cpp": [("<zmq.h>", None), ('"messages/m.h"', None)],
    "kernels/base/b.h": [("<Eigen/Core>", None), ('"kernels/water/w.h"', "out of sight")],
    "kernels/water/w.h": [('"kernels/base/b.h"', None), ('"kernels/acoustics/e.h"', "out of sight")],
    "kernels/acoustics/e.h": [('"kernels/water/w.h"', None)],
    "components/config/c.cpp": [('"kernels/base/b.h"', "out of sight"), ('"messages/m.h"', "out of sight")],
    "components/runtime/r.cpp": [('"kernels/base/b.h"', "out of sight"), ('"components/config/c.cpp"', "out of sight")],
    "scenarios/world/w.h": [('"kernels/base/b.h"', None), ('"components/runtime/ports.h"', "out of sight")],
    "components/runtime/ports.h": [('"components/x/x.h"', "out of sight"), ("<nlohmann/json.hpp>", "json_fwd")],
    "components/x/x.h": [('"components/x/x.h"', None), ('"components/runtime/ports.h"', None),
                         ('"components/y/y.h"', "out of sight"), ("<zmq.hpp>", "components/runtime/bus")],
    "components/x/x_test.cpp": [('"tests/support/s.h"', None), ('"components/y/y.h"', "out of sight")],
    "components/y/y.h": [("<gdal_priv.h>", "terrain_pager"), ('"tests/support/s.h"', "out of sight")],
    "components/terrain_pager/p.cpp": [("<gdal_priv.h>", None)],
    "tools/plot/p.cpp": [("<ogr_spatialref.h>", None), ('"launch/l.h"', None), ('"components/x/x.h"', "out of sight")],
    "launch/l.h": [("<vector>", None)],
    "launch/l.cpp": [("<yaml-cpp/yaml.h>", "components/config"), ('"components/y/y.h"', "out of sight"),
                     ('"tools/plot/p.cpp"', "out of sight")],
    "examples/gyro/g.h": [('"scenarios/scenario_file.h"', None)],
    "scenarios/scenario_file.h": [('"scenarios/world/w.h"', None)],
    "tests/support/s.h": [('"components/x/x.h"', None), ('"kernels/a/a.h"', None)],
}


def self_test():
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        expected = {}
        for path, lines in PLANTED.items():
            (root / path).parent.mkdir(parents=True, exist_ok=True)
            (root / path).write_text("".join(f"#include {target}\n" for target, _ in lines), encoding="utf-8")
            expected.update({f"{path}:{n}": words for n, (_, words) in enumerate(lines, 1) if words})
        expected["examples/gyro"] = "reaches scenarios/world/w.h"
        found = dict(text.split(": ", 1) for text in problems(root)[0])
    wrong = [f"not found: {place} ({words})" for place, words in expected.items() if words not in found.get(place, "")]
    wrong += [f"found by mistake: {place}: {text}" for place, text in found.items() if place not in expected]
    print("\n".join(wrong) or f"{len(expected)} planted offences found, nothing else")
    return 1 if wrong else 0


def main():
    if sys.argv[1:] == ["--self-test"]:
        return self_test()
    here = pathlib.Path(__file__).resolve().parent.parent
    if sys.argv[1:] == ["--dot"]:
        print(dot(includes_of(here)))
        return 0
    if sys.argv[1:] == ["--drawn"]:
        wrong = drawn(here)
        print("\n".join(wrong) or "the drawn rooms are those of the includes")
        return 1 if wrong else 0
    root = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else here
    found, count = problems(root)
    print("\n".join(found + [f"dependencies: {count} files, {len(found)} problems"]))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
