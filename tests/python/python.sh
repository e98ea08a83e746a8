#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The Python package from nothing: a wheel built in an environment of its own, installed in another, tested against the
# golden vectors and the host program; its types; a report looked at in Chromium; cocotb over Icarus. Needs the package
# index for what pip installs; stays in build/python, with the wheel and the report's screenshot.
set -euo pipefail
cd "$(dirname "$0")/../.."
root=$PWD
work=$root/build/python
export PYTHONDONTWRITEBYTECODE=1 PIP_DISABLE_PIP_VERSION_CHECK=1

rm -rf "$work"
mkdir -p "$work"
/usr/bin/python3 -m venv "$work/venv"
pip=("$work/venv/bin/pip" -q)
python=$work/venv/bin/python
"${pip[@]}" wheel --no-deps -w "$work" .
wheel=$(echo "$work"/drogue-*.whl)
"${pip[@]}" install "$wheel"

# The three lines of docs/python.md, from the folder that they name, with no more than 'pip install .' brings.
awk '/^```python/ { inside = 1; next } /^```/ { inside = 0 } inside' docs/python.md >"$work/three_lines.py"
[ "$(wc -l <"$work/three_lines.py")" -eq 3 ]
"$python" "$work/three_lines.py" | grep 'position_m=array'

"${pip[@]}" install "$wheel[report]" pytest mypy cocotb opencv-python-headless

if ! { cmake --preset release && cmake --build --preset release; } >"$work/log"; then
    tail -n 20 "$work/log"
    exit 1
fi
cd "$work" # not the tree: what is installed is what counts
DROGUE_PROGRAM=$root/build/release/src/cli/drogue "$python" -m pytest -q -p no:cacheprovider "$root/tests/python/test_drogue.py"

"$work/venv/bin/mypy" --strict --ignore-missing-imports --cache-dir "$work/mypy" -p drogue | tail -n 1

# A track that is found, lost from sight and found again, as a page.
mkdir frames
"$python" - "$root/vectors/frame/demo.png" <<'END'
import sys
from PIL import Image, ImageChops
demo = Image.open(sys.argv[1]).convert('L')
for i in range(12):
    if i in (5, 6, 7):
        frame = Image.new('L', demo.size, 128)
    else:
        frame = ImageChops.offset(demo, i, 0)
    frame.save(f'frames/{i:02}.png')
END
"$python" -m drogue report frames -o report.html --camera 1465.5,1465.5,403.5,143.5 --drogue 0.35,0.12,0.25
"$python" "$root/tests/python/report.py" report.html report.png || [ $? -eq 77 ]
if "$python" -m drogue report frames/00.png -o frames/00.png --camera 1,1,1,1 2>refusal; then exit 1; fi
grep -q 'is read as input' refusal

# The vectors drive Verilog; a module that is wrong by one comparison is noticed.
export DROGUE_VECTORS=$root/vectors PATH=$work/venv/bin:$PATH
DROGUE_COCOTB_DIR=$work/cocotb "$python" "$root/tests/python/cocotb/test_mask.py" >cocotb.log 2>&1 || {
    tail -n 20 cocotb.log
    exit 1
}
grep -E 'mask: .* cases' cocotb.log
sed 's/distance <= side/distance < side/' "$root/tests/python/cocotb/mask.sv" >wrong.sv
if DROGUE_MASK_SV=$work/wrong.sv DROGUE_COCOTB_DIR=$work/wrong "$python" "$root/tests/python/cocotb/test_mask.py" >wrong.log 2>&1; then
    echo 'python: cocotb notices no wrong mask'
    exit 1
fi
grep -q 'ring differs' wrong.log
echo "python: passed, $(basename "$wheel")"
