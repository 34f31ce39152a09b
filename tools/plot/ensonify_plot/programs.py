"""The project's own programs, which stand beside `ensonify plot`."""
import os
import subprocess

from ensonify_plot.errors import UserError


def run_program(verb: str, *words: str, given: bytes | None = None) -> bytes:
    """What `ensonify VERB` prints. `given` goes to its standard input. Raises UserError with what it says when it fails."""
    program = os.path.join(os.environ["ENSONIFY_BIN"], f"ensonify-{verb}")
    done = subprocess.run([program, *words], input=given, capture_output=True, check=False)
    if done.returncode != 0:
        raise UserError(done.stderr.decode(errors="replace").strip() or f"{program} failed")
    return done.stdout
