#include "umbrage/io/reader/limits.hpp"

#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/sched.h>
#include <linux/seccomp.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <vector>

namespace umbrage::io::reader {
namespace {

void limit(int what, std::size_t value, std::size_t beyond = 0) {
  const rlimit softAndHard{value, value + beyond};
  ::setrlimit(static_cast<__rlimit_resource>(what), &softAndHard);
}

#if defined(__x86_64__)
constexpr std::uint32_t kMachine = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr std::uint32_t kMachine = AUDIT_ARCH_AARCH64;
#else
constexpr std::uint32_t kMachine = 0;
#endif

constexpr std::uint32_t kRefuse = SECCOMP_RET_ERRNO | EPERM;
constexpr std::uint32_t kNumberAt = offsetof(seccomp_data, nr);
constexpr std::uint32_t kMachineAt = offsetof(seccomp_data, arch);

constexpr std::uint32_t lowWordOfArgument(int k) {
  return static_cast<std::uint32_t>(offsetof(seccomp_data, args) + 8 * static_cast<std::size_t>(k));
}

using Program = std::vector<sock_filter>;

void statement(Program& p, int code, std::uint32_t k) { p.push_back({static_cast<std::uint16_t>(code), 0, 0, k}); }
void jump(Program& p, int code, std::uint32_t k, std::uint8_t ifTrue, std::uint8_t ifFalse) {
  p.push_back({static_cast<std::uint16_t>(code), ifTrue, ifFalse, k});
}

void refuseCall(Program& p, long number) {
  jump(p, BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(number), 0, 1);
  statement(p, BPF_RET | BPF_K, kRefuse);
}

// An open is for reading only: refused where the flags, argument `k`, ask for more.
void refuseWritingOpen(Program& p, long number, int k) {
  constexpr std::uint32_t kWrites = O_WRONLY | O_RDWR | O_CREAT | O_TRUNC;
  jump(p, BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(number), 0, 4);
  statement(p, BPF_LD | BPF_W | BPF_ABS, lowWordOfArgument(k));
  jump(p, BPF_JMP | BPF_JSET | BPF_K, kWrites, 0, 1);
  statement(p, BPF_RET | BPF_K, kRefuse);
  statement(p, BPF_RET | BPF_K, SECCOMP_RET_ALLOW);
}

// Threads yes, processes no. The filter cannot look into clone3's arguments; without it the C library uses clone.
void refuseNewProcesses(Program& p) {
  jump(p, BPF_JMP | BPF_JEQ | BPF_K, SYS_clone3, 0, 1);
  statement(p, BPF_RET | BPF_K, SECCOMP_RET_ERRNO | ENOSYS);
  jump(p, BPF_JMP | BPF_JEQ | BPF_K, SYS_clone, 0, 4);
  statement(p, BPF_LD | BPF_W | BPF_ABS, lowWordOfArgument(0));
  jump(p, BPF_JMP | BPF_JSET | BPF_K, CLONE_THREAD, 1, 0);
  statement(p, BPF_RET | BPF_K, kRefuse);
  statement(p, BPF_RET | BPF_K, SECCOMP_RET_ALLOW);
}

Program readOnlyProgram() {
  Program p;
  statement(p, BPF_LD | BPF_W | BPF_ABS, kMachineAt);
  jump(p, BPF_JMP | BPF_JEQ | BPF_K, kMachine, 1, 0);
  statement(p, BPF_RET | BPF_K, kRefuse);
  statement(p, BPF_LD | BPF_W | BPF_ABS, kNumberAt);
  refuseWritingOpen(p, SYS_openat, 2);
  refuseNewProcesses(p);
#ifdef SYS_open
  refuseWritingOpen(p, SYS_open, 1);
  for (const long number : {SYS_creat, SYS_unlink, SYS_rename, SYS_mkdir, SYS_rmdir, SYS_link, SYS_symlink, SYS_chmod,
                            SYS_chown, SYS_lchown, SYS_mknod, SYS_fork, SYS_vfork})
    refuseCall(p, number);
#endif
  for (const long number :
       {SYS_openat2,   SYS_unlinkat,  SYS_renameat,       SYS_renameat2, SYS_mkdirat,   SYS_linkat,
        SYS_symlinkat, SYS_mknodat,   SYS_fchmodat,       SYS_fchownat,  SYS_utimensat, SYS_truncate,
        SYS_setxattr,  SYS_lsetxattr, SYS_execve,         SYS_execveat,  SYS_socket,    SYS_connect,
        SYS_ptrace,    SYS_kill,      SYS_io_uring_setup, SYS_mount})
    refuseCall(p, number);
  statement(p, BPF_RET | BPF_K, SECCOMP_RET_ALLOW);
  return p;
}

void onlyRead() {
  if (kMachine == 0) return;
  Program program = readOnlyProgram();
  const sock_fprog filter{static_cast<unsigned short>(program.size()), program.data()};
  if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0) ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &filter);
}

}  // namespace

void confine(const Limits& limits) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  ::prctl(PR_SET_DUMPABLE, 0);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, limits.cpuSeconds, 1);  // first the signal that says why
  limit(RLIMIT_FSIZE, limits.fileSize);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  limit(RLIMIT_AS, limits.memory);  // the sanitizers reserve terabytes of address space
#endif
  onlyRead();
}

}  // namespace umbrage::io::reader
