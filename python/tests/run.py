#!/usr/bin/python3
"""Runs the tests of a folder by pytest; exits with 77, which ctest takes for skipped, if it or numpy is missing."""

import sys

try:
    import numpy  # noqa: F401
    import pytest
except ImportError as error:
    print(f"skipped: {error}; install python3-pytest and python3-numpy")
    sys.exit(77)

if __name__ == "__main__":  # processes that tests spawn import this file
    sys.exit(pytest.main([sys.argv[1], "-q", "-p", "no:cacheprovider", *sys.argv[2:]]))
