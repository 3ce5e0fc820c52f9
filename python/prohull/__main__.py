"""python -m prohull: the command line, which is a program beside this file."""

import os
import sys
from pathlib import Path

PROGRAM = Path(__file__).with_name("prohull")

if __name__ == "__main__":
    if not PROGRAM.exists():
        sys.exit(f"python -m prohull: the program {PROGRAM} is missing; scripts/setup, pip and Debian's package prohull bring it")
    os.execv(PROGRAM, [str(PROGRAM), *sys.argv[1:]])
