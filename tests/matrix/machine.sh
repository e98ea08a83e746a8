# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0
# Sourced. machine WHERE: sets 'run', the command that an image is appended to; empty for the host.
machine() {
    local semihosting=(-semihosting-config "enable=on,target=native" -nographic -monitor none -serial none -kernel)
    case $1 in
    host) run=() ;;
    mps2-*) run=(qemu-system-arm -M "$1" "${semihosting[@]}") ;;
    virt) run=(qemu-system-riscv32 -M virt -m 64M -bios none "${semihosting[@]}") ;;
    *) return 1 ;;
    esac
}
