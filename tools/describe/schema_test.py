"""Editors' help for launch, recipe, scenario and mission files.   schema_test.py BIN_FOLDER

The schemas that ship are those of the lists; every such file of the project, and the manual's mission, is valid; every key has a
sentence to show; planted mistakes are found where they are.
"""
import copy
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

import jsonschema
import yaml

SOURCE = pathlib.Path(os.environ["ENSONIFY_SOURCE"])
FOLDER = SOURCE / "launch/schema"
MODELINE = re.compile(r"^# yaml-language-server: \$schema=(\S+)$", re.MULTILINE)


class Yaml12(yaml.SafeLoader):
    """Plain scalars as YAML 1.2 has them: 1e3 is a number, `on` a text."""


Yaml12.yaml_implicit_resolvers = {}
for tag, pattern, first in (
        ("bool", r"^(?:true|false)$", "tf"),
        ("null", r"^(?:null|~|)$", ["n", "~", ""]),
        ("int", r"^[-+]?[0-9]+$", "-+0123456789"),
        ("float", r"^[-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]+)?$", "-+.0123456789")):
    Yaml12.add_implicit_resolver(f"tag:yaml.org,2002:{tag}", re.compile(pattern), list(first))
Yaml12.add_constructor("tag:yaml.org,2002:float", lambda loader, node: float(node.value))
Yaml12.add_constructor("tag:yaml.org,2002:int", lambda loader, node: int(node.value))


def texts(value):
    """Keys as editors see them: texts, also where a scenario numbers its sediments."""
    if isinstance(value, dict):
        return {str(key): texts(of) for key, of in value.items()}
    return [texts(item) for item in value] if isinstance(value, list) else value


def load(path):
    return texts(yaml.load(path.read_text(encoding="utf-8"), Yaml12))


def schema_of(kind):
    done = subprocess.run([os.path.join(sys.argv[1], "ensonify-describe"), kind, "--schema"], capture_output=True,
                          text=True, check=True)
    written = (FOLDER / f"{kind}.json").read_text(encoding="utf-8")
    assert done.stdout == written, f"launch/schema/{kind}.json: write it with cmake/generate_parameters.py"
    schema = json.loads(written)
    jsonschema.Draft202012Validator.check_schema(schema)
    return jsonschema.Draft202012Validator(schema)


def problems(validator, document):
    """Where and what: of alternatives, what is wrong with the nearest."""
    found = []
    for error in validator.iter_errors(document):
        best = jsonschema.exceptions.best_match([error])
        found.append((".".join(str(step) for step in best.absolute_path), best.message))
    return found


def keys_without_sentence(schema, path=""):
    for key, value in schema.items():
        if not isinstance(value, dict):
            for i, item in enumerate(value if isinstance(value, list) and key != "oneOf" else []):  # oneOf: rules for keys above
                if isinstance(item, dict):
                    yield from keys_without_sentence(item, f"{path}/{key}[{i}]")
        elif key == "properties":
            for name, of in value.items():
                if not of.get("description"):
                    yield f"{path}/{name}"
                yield from keys_without_sentence(of, f"{path}/{name}")
        elif key not in ("if", "then"):
            yield from keys_without_sentence(value, f"{path}/{key}")


def planted(validator, document, path, value, where, words):
    """A mistake in a valid document: `value` at `path` (None: removed); what is found must say so."""
    document = copy.deepcopy(document)
    *steps, last = path
    inner = document
    for step in steps:
        inner = inner[step]
    if value is None:
        del inner[last]
    else:
        inner[last] = value
    found = problems(validator, document)
    assert any(place == where and words in message for place, message in found), (path, found)


shipped = {"launch": [], "recipe": [], "scenario": [], "mission": []}
validators = {kind: schema_of(kind) for kind in shipped}
for top in ("launch", "scenarios", "bench", "docs", "examples", "tests"):
    for file in sorted((SOURCE / top).rglob("*.yaml")):
        for kind, files in shipped.items():
            if re.search(rf"^ensonify: {kind}/1", file.read_text(encoding="utf-8"), re.MULTILINE):
                files.append(file)
                wrong = problems(validators[kind], load(file))
                assert not wrong, f"{file}: {wrong}"

for kind, files in shipped.items():
    for file in files:
        if file.relative_to(SOURCE).parts[0] in ("launch", "scenarios"):
            line = MODELINE.search(file.read_text(encoding="utf-8"))
            assert line, f"{file} lacks its `# yaml-language-server: $schema=` line"
            assert (file.parent / line[1]).resolve() == FOLDER / f"{kind}.json", f"{file}: {line[1]}"
    silent = list(keys_without_sentence(validators[kind].schema))
    assert not silent, f"{kind}: no sentence for {silent}"

bay = load(SOURCE / "scenarios/bay/scenario.yaml")
scenario = validators["scenario"]
planted(scenario, bay, ["site", "latitude_deg"], 91, "site.latitude_deg", "maximum of 89.9")
planted(scenario, bay, ["mission", "sped_mps"], 2, "mission", "'sped_mps' was unexpected")
planted(scenario, bay, ["seabed", "kind"], "rasta", "seabed.kind", "is not one of ['layers', 'raster', 'tiles']")
planted(scenario, bay, ["mission"], None, "", "'mission' is a required property")
assert not problems(scenario, {"ensonify": "scenario/1", "include": "scenarios/bay/scenario.yaml", "water": {"cast": "x.csv"}})
planted(scenario, bay, ["seabed", "kind"], None, "seabed", "'kind' is a required property")
page = (SOURCE / "scenarios/README.md").read_text(encoding="utf-8")
overlay = texts(yaml.load(re.search(r"^```yaml\n(ensonify: scenario/1\ninclude: .*?)^```", page, re.MULTILINE | re.DOTALL)[1], Yaml12))
assert not problems(scenario, overlay), problems(scenario, overlay)
planted(scenario, bay, ["seabed", "sediments"], {"0": "medium sant"}, "seabed.sediments.0", "is not")

manual = (SOURCE / "docs/manual/missions.md").read_text(encoding="utf-8")
example = texts(yaml.load(re.search(r"^```yaml\n(ensonify: mission/1\n.*?)^```", manual, re.MULTILINE | re.DOTALL)[1], Yaml12))
mission = validators["mission"]
assert not problems(mission, example), problems(mission, example)
planted(mission, example, ["repeat"], 0, "repeat", "minimum of 1")
planted(mission, example, ["steps", 3, "source_levl_db"], 200, "steps.3", "not valid under any")
planted(mission, example, ["file"], "other.yaml", "", "'file' was unexpected")

demo = load(SOURCE / "launch/demo.yaml")
launch = validators["launch"]
planted(launch, demo, ["processes", "boat", "obsever"], True, "processes.boat", "'obsever' was unexpected")
planted(launch, demo, ["processes", "pager", "config"], {"rate_hz": 21}, "processes.pager.config.rate_hz", "21")
planted(launch, demo, ["processes", "pilot", "config"], {"patience": 1}, "processes.pilot.config", "'patience' was unexpected")
planted(launch, demo, ["clock"], {"rate": "fast"}, "clock.rate", "fast")

# Forms: schema and reader accept and refuse the same.
WORLD = {"site": {"latitude_deg": 53, "longitude_deg": -9}, "seabed": {"kind": "layers"},
         "vehicles": {"boat": {}}, "mission": {"runlines": [{"from_m": [0, -50], "to_m": [0, 50]}]}}
WALL, BARS = {"from_m": [0, 0], "to_m": [9, 0]}, [{"from_m": [0, 0, 0], "to_m": [0, 0, 3], "diameter_m": 1}]
STREWN = {"count": 3, "from_m": [0, 0], "to_m": [9, 0], "width_m": 1}
M2 = {"constituent": "M2", "amplitude_m": 1}
SAMPLES = [{"depth_m": 0, "sound_speed_mps": 1500}]
LINE, SPECTRAL = [[0, -50], [0, 50]], {"outer_scale_m": 5}


def seabed(**keys):
    return {"kind": "layers", **keys}


SECTIONS = [  # section, value, whether it is valid
    ("site", {"name": "x"}, False), ("site", {**WORLD["site"], "origin": "raster"}, False),
    ("water", {"sound_speed_mps": 1500}, True), ("water", {"profile": SAMPLES}, True),
    ("water", {"sound_speed_mps": 1500, "profile": SAMPLES}, False),
    ("water", {"applied": {}}, False), ("water", {"applied": {"sound_speed_mps": 1490}}, True),
    ("vertical", {"tide": {}}, False), ("vertical", {"tide": {"constant_m": 1}}, True),
    ("vertical", {"tide": {"constant_m": 1, "mean_m": 1}}, False),
    ("vertical", {"tide": {"constituents": [M2], "mean_m": 1}}, True), ("vertical", {"tide": {"constituents": [{}]}}, False),
    ("vertical", {"geoid_above_ellipsoid_m": 1, "datum_above_geoid_m": 2}, True),
    ("seabed", {}, False), ("seabed", {"kind": "raster"}, False), ("seabed", {"kind": "sand"}, False),
    ("seabed", seabed(raster={"path": "x", "values": "depth"}), False), ("seabed", seabed(size_m=[500, 400]), True),
    ("seabed", seabed(sediments={"0": "clay"}), True), ("seabed", seabed(sediments={"0": "sponge"}), False),
    ("seabed", seabed(sediments={"0": {"name": "clay", "capped": True}}), True), ("seabed", seabed(sediments={"0": {}}), False),
    ("seabed", seabed(sediments={"0": {"lambert_mu_db": -20}}), True), ("seabed", seabed(sediments={"sand": "clay"}), False),
    ("seabed", seabed(sediments={"0": {"lambert_mu_db": -20, "capped": True}}), False),
    ("seabed", seabed(sediments={"0": {"lambert_mu_db": -20, "name": "clay"}}), False),
    ("seabed", seabed(sediments={"0": {"gsab": {"specular_db": -10, "specular_width_deg": 5, "diffuse_db": -20}}}), True),
    ("seabed", seabed(layers={"a": {"plane": {}}}), True), ("seabed", seabed(layers={"a": {"plane": {}, "ridge": {}}}), False),
    ("seabed", seabed(layers={"a": {"plane": {}}, "b": {"sediment": 0}}), True),
    ("seabed", seabed(layers={"a": {"spectral": {**SPECTRAL, "rms_m": 1}}}), True),
    ("seabed", seabed(layers={"a": {"spectral": {**SPECTRAL, "as_sediment": "clay"}}}), True),
    ("seabed", seabed(layers={"a": {"spectral": {**SPECTRAL, "rms_m": 1, "as_sediment": "clay"}}}), False),
    ("seabed", seabed(layers={"a": {"spectral": SPECTRAL}}), False),
    ("seabed", seabed(layers={"a": {"plane": {}, "mask": {"any": [{"any": [{"sediment": [0, 3]}]}, {"slope_deg": {"to": 3}}]}}}), True),
    ("seabed", seabed(layers={"a": {"plane": {}, "mask": {"sediment": [1.5]}}}), False),
    ("seabed", seabed(meshes={"a": {"sheet_pile_wall": WALL}}), True), ("seabed", seabed(meshes={"a": {}}), False),
    ("seabed", seabed(meshes={"a": {"sheet_pile_wall": WALL, "unit_m": 2}}), False),
    ("seabed", seabed(meshes={"a": {"sheet_pile_wall": WALL, "bars": BARS}}), False),
    ("seabed", seabed(meshes={"a": {"bars": BARS, "tilt_deg": 3}}), True), ("seabed", seabed(meshes={"a": {"bars": BARS, "strewn": STREWN}}), True),
    ("seabed", seabed(meshes={"a": {"bars": BARS, "strewn": STREWN, "tilt_deg": 3}}), False),
    ("vehicles", {"boat": {"kind": "hydrodynamic"}}, False), ("vehicles", {"boat": {"dynamics": "x.yaml"}}, False),
    ("vehicles", {"boat": {"start": "first_runline"}}, True), ("vehicles", {"boat": {"start": "here"}}, False),
    ("vehicles", {"boat": {"start": {"position_m": [0, 0, -1]}}}, True), ("vehicles", {"boat": {"start": {}}}, False),
    ("vehicles", {"boat": {"mountings": {"bow": {"actual": {}}}}}, True), ("vehicles", {"boat": {"mountings": {"bow": {}}}}, False),
    ("mission", {**WORLD["mission"], "steps": []}, False), ("mission", {"steps": [{"line": LINE}]}, True),
    ("mission", {"steps": [{"line": LINE, "radius_m": 3}]}, False), ("mission", {"steps": [{"line": LINE}, {"keep": [0, 0]}]}, False),
    ("mission", {"steps": [{"line": LINE}, {"keep": [0, 0], "for_s": 3}, {"wait_s": 3}, {"speed_mps": 1}, {"mark": "x"}]}, True),
    ("mission", {"lawnmower": {"length_m": 50, "spacing_m": 5, "count": 2}}, True), ("mission", {"lawnmower": {}}, False),
    ("mission", {"steps": [{"line": LINE, "wait_s": 3}]}, False), ("mission", {"steps": [{"line": LINE}, None]}, False),
    ("seabed", seabed(sediments={"0": None}), False), ("seabed", seabed(layers={"a": None}), False),
    ("seabed", seabed(meshes={"a": {"bars": [None]}}), False), ("water", {"sound_speed_mps": 1500, "scattering_layers": [None]}, False),
    ("vehicles", {"boat": {"mountings": {"bow": None}}}, False)]
PROCESS = {"run": "recorder", "observer": True}
LAUNCHES = [  # keys over those of a launch of one observer, whether they are valid
    ({"processes": {"a": {**PROCESS, "cpus": [0]}}}, True), ({"processes": {"a": {**PROCESS, "cpus": [0.5]}}}, False),
    ({"processes": {"a": {**PROCESS, "cpus": [4096]}}}, False), ({"processes": {"a": {**PROCESS, "env": {"A": 1}}}}, True),
    ({"processes": {"a": {**PROCESS, "run": ["true"]}}}, True), ({"processes": {"a": {**PROCESS, "run": {}}}}, False),
    ({"clock": {"rate": "free"}}, True), ({"clock": {"rate": 2}}, True), ({"clock": {"rate": "fast"}}, False), ({"clock": {"rate": 0}}, False),
    ({"wiring": {"a.b": "c/d"}}, True), ({"wiring": {"a.b": {"topic": "c/d", "delay_ms": 3}}}, True), ({"wiring": {"a.b": {"delay_ms": 3}}}, False),
    ({"after": [["true", 1]]}, True), ({"after": ["true"]}, False), ({"duration_s": 0}, False),
    ({"expect": [{"exit": {"process": "a", "code": 0}}]}, True), ({"expect": [{"cuont": {"topic": "a/b", "min": 1}}]}, False),
    ({"expect": [{"count": {"topic": "a/b", "min": 1}}]}, True), ({"expect": [{"count": {"tpoic": "a/b", "min": 1}}]}, False),
    ({"expect": [{"bounds": {"topic": "a/b", "field": "x", "max": "high"}}]}, False),
    ({"scenario": {"ensonify": "scenario/1", **WORLD}}, True), ({"scenario": ["x.yaml"]}, False),
    ({"scenario": {"ensonify": "scenario/1", **WORLD, "site": {"latitude_deg": 91, "longitude_deg": 0}}}, False),
    ({"wiring": {"a.b": None}}, False), ({"processes": {"a": PROCESS, "b": None}}, False)]


def read(document):
    """What `ensonify check` says of a launch file; "" where nothing is wrong but what ports and wiring need a run for."""
    with tempfile.TemporaryDirectory(prefix="ensonify-schema-") as folder:
        path = pathlib.Path(folder) / "launch.yaml"
        path.write_text(yaml.safe_dump(document, sort_keys=False), encoding="utf-8")
        done = subprocess.run([os.path.join(sys.argv[1], "ensonify-check"), path], capture_output=True, text=True, check=False)
    return "\n".join(line for line in done.stderr.splitlines() if not re.search("no process (has this input|publishes)|^warning", line))


def agree(valid, wrong, said, what):
    assert (not wrong) == valid, f"schema: {what} is to be {'valid' if valid else 'refused'}: {wrong}"
    assert (not said) == valid, f"reader: {what} is to be {'valid' if valid else 'refused'}: {said}"


observer = {"ensonify": "launch/1", "processes": {"a": PROCESS}}
for section, value, valid in SECTIONS:
    document = {"ensonify": "scenario/1", **WORLD, section: value}
    agree(valid, problems(scenario, document), read({**observer, "scenario": document}), {section: value})
for keys, valid in LAUNCHES:
    document = {**observer, **keys}
    agree(valid, problems(launch, document), read(document), keys)
print(f"{len(shipped['launch'])} launch and {len(shipped['scenario'])} scenario files are valid")
