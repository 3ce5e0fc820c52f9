#!/bin/sh
# Fails unless PAGE is what COMMAND prints: is_current.sh PAGE COMMAND...
set -eu
page=$1
shift
printed=$(mktemp)
trap 'rm -f "$printed"' EXIT
"$@" >"$printed"
diff -u "$page" "$printed" && exit
echo "$page is no longer what the program says; scripts/reference renews it"
exit 1
