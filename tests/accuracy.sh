#!/usr/bin/env bash
# Runs the beams with every setting of docs/accuracy.md and writes its tables; about two hours on two idle cores.
# Results go to the folder given, results/accuracy without one; runs found there are not repeated.
set -euo pipefail
cd "$(dirname "$0")/.."
cargo build --release -p rc-beams -p fe-tests --bins
target="${CARGO_TARGET_DIR:-target}/release"
"$target/accuracy" "$target/rc-beams" "${1:-results/accuracy}"
