"""`ensonify record repair` as its users see it: exit codes, words, JSON, and the official Python reader (PyPI mcap) reads
what it refused before. Exit code 77: the reader is not installed.     repair_test.py BIN_FOLDER WRITE_SAMPLE_RECORD"""
import json
import os
import subprocess
import sys
import tempfile

try:
    from mcap.exceptions import McapError
    from mcap.reader import SeekingReader
except ImportError:
    print("skipped: PyPI's mcap is not installed (./dev test installs it into build/venv)")
    sys.exit(77)


def repair(*words):
    done = subprocess.run([os.path.join(sys.argv[1], "ensonify-record"), "repair", *words], capture_output=True, text=True)
    return done.returncode, done.stdout, done.stderr


def read(file):
    """Number of messages by the summary, and those found by following it."""
    with open(file, "rb") as stream:
        reader = SeekingReader(stream, validate_crcs=True)
        summary = reader.get_summary()
        return summary.statistics.message_count, sum(1 for _ in reader.iter_messages())


with tempfile.TemporaryDirectory() as folder:
    file, text = os.path.join(folder, "run.mcap"), os.path.join(folder, "text")
    subprocess.run([sys.argv[2], file], check=True)
    assert repair(file) == (0, f"{file}: is whole, with 53 messages to t=2.400 s; nothing was changed\n", ""), repair(file)

    data = open(file, "rb").read()
    with open(file, "wb") as stream:
        stream.write(data[:len(data) // 2])
    try:
        read(file)
        raise AssertionError("the official reader took a record without its end")
    except (McapError, OSError, AttributeError):
        pass
    code, out, error = repair("--json", file)
    result = json.loads(out)
    assert (code, error, result["was_whole"]) == (0, "", False), (code, error, result)
    assert result["kept_bytes"] + result["dropped_bytes"] == len(data) // 2, result
    assert 0 < result["messages"] < 53, result
    assert read(file) == (result["messages"], result["messages"]), (read(file), result)

    with open(text, "w", encoding="utf-8") as stream:
        stream.write("no record at all")
    assert repair(text) == (2, "", f"ensonify record: {text}: is no record: it is not an MCAP file; nothing was changed\n"), repair(text)
    assert repair(folder + "/none")[0] == 2
    assert repair()[0] == 2
print("ensonify record repair answers as documented")
