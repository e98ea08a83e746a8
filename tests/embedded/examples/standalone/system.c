/* SPDX-License-Identifier: Apache-2.0 */
/* What newlib asks of a system: characters out and the end by semihosting, which QEMU and debuggers answer. On a board
 * without a debugger put a UART into _write() and a loop into _exit(). */
#include <errno.h>
#include <stddef.h>
#include <stdint.h>
#include <sys/stat.h>

extern char heap_begin[], heap_end[]; /* board.ld */
int _write(int file, const char *text, int length);
void *_sbrk(ptrdiff_t bytes);
void _exit(int status);
int _close(int file);
int _fstat(int file, struct stat *out);
int _getpid(void);
int _isatty(int file);
int _kill(int process, int signal);
int _lseek(int file, int offset, int from);
int _read(int file, char *text, int length);
void _fini(void);

static void semihosting(uint32_t operation, uintptr_t argument)
{
    register uint32_t r0 __asm__("r0") = operation;
    register uintptr_t r1 __asm__("r1") = argument;
    __asm__ volatile("bkpt 0xAB" : "+r"(r0) : "r"(r1) : "memory");
}

int _write(int file, const char *text, int length)
{
    int i;
    (void)file;
    for (i = 0; i < length; i++) {
        semihosting(0x03, (uintptr_t)&text[i]); /* SYS_WRITEC */
    }
    return length;
}

void *_sbrk(ptrdiff_t bytes)
{
    static char *end = heap_begin;
    char *begin = end;
    if (bytes > heap_end - end) {
        errno = ENOMEM;
        return (void *)-1;
    }
    end += bytes;
    return begin;
}

void _exit(int status)
{
    semihosting(0x18, status == 0 ? 0x20026 : 0x20023); /* SYS_EXIT: ApplicationExit, or an error */
    for (;;) {}
}

int _close(int file) { return (void)file, -1; }
int _fstat(int file, struct stat *out) { return (void)file, out->st_mode = S_IFCHR, 0; }
int _getpid(void) { return 1; }
int _isatty(int file) { return (void)file, 1; }
int _kill(int process, int signal) { return (void)process, (void)signal, -1; }
int _lseek(int file, int offset, int from) { return (void)file, (void)offset, (void)from, 0; }
int _read(int file, char *text, int length) { return (void)file, (void)text, (void)length, 0; }
void _fini(void) {}
