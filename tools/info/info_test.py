"""`ensonify info` as scripts see it: exit codes, text, JSON.   info_test.py BIN_FOLDER WRITE_SAMPLE_FORMATS"""
import json
import os
import subprocess
import sys
import tempfile
import time


def info(*words):
    done = subprocess.run([os.path.join(sys.argv[1], "ensonify-info"), *words], capture_output=True, text=True)
    return done.returncode, done.stdout, done.stderr


with tempfile.TemporaryDirectory() as folder:
    subprocess.run([sys.argv[2], folder], check=True)
    files = [os.path.join(folder, name) for name in ("sample.all", "sample.kmall", "sample.xtf")]
    code, out, error = info(*files)
    assert (code, error) == (0, ""), (code, error)
    assert out.count("faults      0\n") == 3 and "EM 2040 serial 157" in out, out

    # By content, whatever the name.
    renamed = os.path.join(folder, "renamed.xtf")
    os.rename(files[0], renamed)
    code, out, _ = info("--json", renamed, *files[1:])
    all_, kmall, xtf = json.loads(out)
    assert [[each["numbers"] for each in one["water_columns"].values()] for one in (all_, kmall, xtf)] == [[2], [3], []], out
    assert code == 0 and all_["format"] == "Kongsberg .all" and xtf["format"] == "Triton XTF", out
    assert all_["pings"]["serial 157"]["numbers"] == kmall["pings"]["head 1"]["numbers"] == 2, out
    assert abs(all_["depth_m"]["high"] - kmall["depth_m"]["high"]) < 1e-4, out
    assert all_["first"] == kmall["first"] == "2026-03-10T12:00:00.000Z", out
    assert {kind: entry["count"] for kind, entry in all_["datagrams"].items() if kind in "IiNXYk"} == {
        "I": 1, "i": 1, "N": 2, "X": 2, "Y": 2, "k": 2}, out

    # A fault has its place and what is allowed; the rest is read.
    data = bytearray(open(files[1], "rb").read())
    data[0] ^= 0x40
    damaged = os.path.join(folder, "damaged.kmall")
    open(damaged, "wb").write(data)
    code, out, error = info(damaged)
    assert code == 1 and error == "" and "faults      1, " in out and "  at          0: the length" in out, out

    # What cannot be read at all is named, and the others are read all the same; the worst decides.
    foreign, empty = os.path.join(folder, "foreign"), os.path.join(folder, "empty")
    open(foreign, "w", encoding="utf-8").write("no record at all")
    open(empty, "w", encoding="utf-8").close()
    missing = os.path.join(folder, "none")
    code, out, error = info("--json", foreign, empty, missing, folder, damaged)
    assert code == 2, code
    assert error.splitlines() == [
        f"{foreign}: its first megabyte has no datagram of a known format; known are .all, .wcd, .kmall, .kmwcd and XTF",
        f"{empty}: it is empty", f"{missing}: cannot be read: No such file or directory",
        f"{folder}: cannot be read: it is not a regular file"], error
    assert ["error" in entry for entry in json.loads(out)] == [True] * 4 + [False], out
    # Text that is no UTF-8, in a file or as its name, is shown escaped.
    named = os.path.join(folder.encode(), b"caf\xe9.kmall")
    raw = open(files[1], "rb").read()
    open(named, "wb").write(raw.replace(b"EM 2040", b"EM 20\xe90"))
    done = subprocess.run([os.path.join(sys.argv[1], "ensonify-info").encode(), b"--json", named], capture_output=True)
    assert done.returncode == 0, done
    (entry,) = json.loads(done.stdout)
    assert entry["file"].endswith("caf\\xe9.kmall") and "EM 20\\xe90" in entry["system"], entry

    # Bytes that all look like the beginning of large frames cost no more than time in proportion to them.
    kmall_like = (b"\x00\x00\x08\x00#AAA" * 600_000)[:4_000_000]
    all_like = b"".join(b"\x00\x00\x0f\x00\x02X\xf8\x07\xe0\x32\x35\x01\x00\x00\x00\x00\x03" for _ in range(150_000))
    for name, content in (("like.kmall", kmall_like), ("like.all", all_like)):
        hostile = os.path.join(folder, name)
        open(hostile, "wb").write(content)
        began = time.monotonic()
        code = info(hostile)[0]
        assert code in (1, 2) and time.monotonic() - began < 20, (name, code, time.monotonic() - began)
    assert info()[0] == 2
    assert "0 no fault, 1 faults found, 2 a file cannot be read at all" in info("--help")[1]
print("ensonify info answers as documented")
