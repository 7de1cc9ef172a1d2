#!/usr/bin/env bash
# Installs CalculiX where Debian's packages are at hand and writes docs/performance.md; on an idle machine, five minutes.
set -euo pipefail
cd "$(dirname "$0")/.."
command -v ccx >/dev/null || apt-get install -y calculix-ccx || echo 'without CalculiX' >&2
cargo run --release -p fe-tests --bin performance
