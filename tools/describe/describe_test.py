"""What `ensonify describe` says of everything it lists.   describe_test.py BIN_FOLDER"""
import json
import os
import subprocess
import sys

SOURCE = os.environ["ENSONIFY_SOURCE"]


def describe(*words, wanted=0):
    done = subprocess.run([os.path.join(sys.argv[1], "ensonify-describe"), *words], capture_output=True, text=True)
    assert done.returncode == wanted, f"describe {words}: exit code {done.returncode}, {done.stderr}"
    return done.stdout if wanted == 0 else done.stderr


everything = json.loads(describe("--json"))
folders = {f for f in os.listdir(f"{SOURCE}/components") if os.path.exists(f"{SOURCE}/components/{f}/default.yaml")}
assert set(everything["components"]) == folders, (everything["components"], folders)

reported = []
for component in everything["components"]:
    with open(f"{SOURCE}/components/{component}/default.yaml", encoding="utf-8") as file:
        assert describe(component, "--yaml") == file.read(), component
    assert describe(component, "--table").startswith("| parameter |"), component
    assert json.loads(describe(component, "--schema"))["title"] == component
    facts = json.loads(describe(component, "--json"))
    assert facts["about"] and facts["parameters"] is not None, component
    if "ports" in facts:
        reported.append(component)
        assert any(p["type"] == "health/1" for p in facts["ports"]["out"]), component
assert {"vehicle", "multibeam", "recorder"} <= set(reported), f"only {reported} tell their ports"

for message in everything["messages"]:
    assert json.loads(describe(message, "--json"))["title"] == message
    name = message.split("/")[0]
    if name in everything["components"]:
        assert describe(name).startswith(f"{name}: ") and describe(name).endswith(f"a message, too: {message}\n")
    else:
        assert describe(name).startswith(message), message

assert describe("pimg", wanted=2) == "pimg: is neither a component nor a message type; did you mean ping?\n"
describe("ping", "--yaml", wanted=2)
describe("ping", "--table", wanted=2)
describe("--table", wanted=2)
describe("scenario.watre", "--table", wanted=2)
assert "`profile[].depth_m`" in describe("scenario.water", "--table")
with open(f"{SOURCE}/docs/manual/messages.md", encoding="utf-8") as file:
    assert describe("--reference") == file.read()
print(f"{len(folders)} components and {len(everything['messages'])} messages are described")
