#!/usr/bin/env bash
# Writes docs/performance.md; on an idle machine, eight minutes. Installs CalculiX where Debian's packages are at hand, and PARDISO
# where those of Python are.
set -euo pipefail
cd "$(dirname "$0")/.."
command -v ccx >/dev/null || apt-get install -y calculix-ccx || echo 'without CalculiX' >&2
packages="$PWD/target/pardiso"
if [ -x "$packages/bin/pip" ] || python3 -m venv "$packages"; then
    "$packages/bin/pip" install -q pypardiso && export PARDISO_PYTHON="$packages/bin/python" || echo 'without PARDISO' >&2
fi
cargo run --release -p fe-tests --bin performance
