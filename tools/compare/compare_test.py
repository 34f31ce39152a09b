"""`ensonify compare` as scripts see it: exit codes, the first difference, JSON.   compare_test.py BIN_FOLDER WRITE_SAMPLE_RECORD"""
import json
import os
import subprocess
import sys
import tempfile


def compare(*words):
    done = subprocess.run([os.path.join(sys.argv[1], "ensonify-compare"), *words], capture_output=True, text=True)
    return done.returncode, done.stdout, done.stderr


with tempfile.TemporaryDirectory() as folder:
    a, b, cut, text = (os.path.join(folder, name) for name in ("a.mcap", "b.mcap", "cut.mcap", "text"))
    subprocess.run([sys.argv[2], a], check=True)
    subprocess.run([sys.argv[2], b], check=True)
    assert open(a, "rb").read() == open(b, "rb").read(), "two records of the same messages differ"
    assert compare(a, b) == (0, "same: 53 messages on 3 topics\n", ""), compare(a, b)

    # A chunk that a disk has damaged, or that is not there, is lost messages.
    data = open(a, "rb").read()
    with open(cut, "wb") as file:
        file.write(data[:len(data) // 2])
    code, out, _ = compare(a, cut)
    assert code == 6 and "the message is there in A, missing in B" in out and "note: B ends early" in out, out
    code, out, _ = compare("--json", a, cut)
    result = json.loads(out)
    assert code == 6 and not result["same"] and result["first"]["b"] == "missing", result
    lost = {t["topic"]: t["only_a"] for t in result["topics"]}
    assert lost["bow/soundings"] > 0 and sum(t["a"] for t in result["topics"]) == 53, result
    assert compare("--topic", "bow/health", a, cut)[0] == 0

    with open(text, "w", encoding="utf-8") as file:
        file.write("no record at all")
    assert compare(a, text) == (2, "", f"{text}: is no record: it is not an MCAP file\n"), compare(a, text)
    assert compare(a, folder + "/none")[0] == 2
    assert compare(a)[0] == 2
print("ensonify compare answers as documented")
