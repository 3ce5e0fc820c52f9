#!/bin/sh
# Runs a script of checks, each of which names what it defends: run.sh SCRIPT PROHULL [DIVISOR]. The last line counts them.
set -u
prohull=$2 divisor=${3:-1}
. "$(dirname "$0")/checks.sh"
. "$(dirname "$0")/meshes.sh"
. "$1"
count_checks
