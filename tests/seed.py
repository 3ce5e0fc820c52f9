"""The seed of random tests in Python, as tests/random.h has it: 1 unless PROHULL_TEST_SEED is another number or `random`."""

import os
import random

_said = os.environ.get("PROHULL_TEST_SEED") or "1"
SEED = random.SystemRandom().randrange(2**32) if _said == "random" else int(_said)
REPLAY = f"PROHULL_TEST_SEED={SEED}"
