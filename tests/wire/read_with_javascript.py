"""The official JavaScript reader (npm @mcap/core) finds in a record what was written. Exit code 77: there is no npm, or
its registry cannot be reached.

  read_with_javascript.py WRITE_SAMPLE_RECORD
"""
import os
import shutil
import subprocess
import sys
import tempfile

PACKAGE = "@mcap/core@2.2.2"


def skip(why):
    print(f"skipped: {why}")
    sys.exit(77)


def main():
    if not shutil.which("node") or not shutil.which("npm"):
        skip("node and npm are not installed")
    modules = os.path.join(os.environ["ENSONIFY_BUILD"], "npm")
    os.makedirs(modules, exist_ok=True)
    if not os.path.isdir(os.path.join(modules, "node_modules", "@mcap", "core")):
        install = subprocess.run(["npm", "install", "--prefix", modules, "--no-audit", "--no-fund", "--save-exact", PACKAGE],
                                 capture_output=True, text=True, timeout=100)
        if install.returncode != 0:
            skip(f"npm cannot install {PACKAGE}: {install.stderr.strip().splitlines()[-1:]}")
    script = os.path.join(modules, "read_record.mjs")  # modules are searched for beside the script
    shutil.copyfile(os.path.join(os.path.dirname(os.path.abspath(__file__)), "read_record.mjs"), script)
    with tempfile.TemporaryDirectory() as folder:
        file = os.path.join(folder, "sample.mcap")
        subprocess.run([sys.argv[1], file], check=True)
        sys.exit(subprocess.run(["node", script, file]).returncode)


if __name__ == "__main__":
    main()
