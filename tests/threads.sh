#!/usr/bin/env bash
# Runs all 21 beams with one thread and with one per core, compares what they write byte by byte, but for the summary, which holds
# times, and tells how long each takes; about seven minutes on two idle cores. Results go to the folder given, results/threads
# without one.
set -euo pipefail
cd "$(dirname "$0")/.."
cargo build --release -p rc-beams
program="${CARGO_TARGET_DIR:-target}/release/rc-beams"
folder="${1:-results/threads}"
cores="$(nproc)"
for threads in "$cores" 1; do
    rm -rf "$folder/$threads"
    begin=$SECONDS
    "$program" run all --threads "$threads" -o "$folder/$threads" > /dev/null 2>&1
    echo "$threads threads: $((SECONDS - begin)) s"
done
diff --recursive --brief --exclude summary.json "$folder/1" "$folder/$cores"
echo "all 21 beams the same to the last bit: $(find "$folder/1" -type f ! -name summary.json | wc -l) files"
