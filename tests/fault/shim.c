// What a failing disk, a signal or a power cut would do to a program, for tests: loaded with LD_PRELOAD, it stands
// between the program and its system calls on files below one folder. Everything else passes.
//
// SHIM_FOLDER   absolute path; calls on it and on what is below count (1, 2, 3, ... through all threads of the process)
// SHIM_CALLS    file that gets a line per counted call: "number call flags path", and "!" before the one that failed
// SHIM_NTH      this call fails, and with SHIM_ON=1 every later one that can fail that way
// SHIM_ERROR    how: ENOSPC, EDQUOT, EIO, EINTR, or "short" (half of the bytes are written, or read)
// SHIM_LOG      file that gets what was done, in its order and with all bytes: power_log.py reads it. Also what the
//               program said on stdout and stderr, so that a claim stands behind the fsync it relies on, or before it
// SHIM_FREE     bytes that statvfs says are free
// SHIM_FLOCK    errno name that every flock fails with (ENOLCK: a cluster without locks)
// SHIM_DISK=1   fsync does reach the disk; else it is only noted, which is all that a simulated power cut looks at
//
// One lock is held over call and record, so that the order in the log is the order of what happened. glibc's own calls
// (fopen, opendir, stdio's writes) do not pass through here; the program writes what must be safe by open and pwrite.
#define _GNU_SOURCE
#include <dirent.h>
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

#define MOST_FILES 4096

static pthread_mutex_t guard = PTHREAD_MUTEX_INITIALIZER;
static char folder[PATH_MAX];
static size_t folder_length;
static int calls_file = -1, log_file = -1;
static long nth;
static long* counted;  // of the process and of children that it forks
static int on, shorten, error_number, flock_error, real_sync;
static long long free_bytes = -1;
static long opened;
static struct {
  long serial;  // 0: none of ours
  char path[512];
} files[MOST_FILES];

static int number_of(char const* name) {
  static struct {
    char const* name;
    int number;
  } const known[] = {{"ENOSPC", ENOSPC}, {"EDQUOT", EDQUOT},         {"EIO", EIO},      {"EINTR", EINTR},
                     {"ENOLCK", ENOLCK}, {"EOPNOTSUPP", EOPNOTSUPP}, {"ENOSYS", ENOSYS}};
  for (size_t i = 0; name && i < sizeof(known) / sizeof(*known); ++i)
    if (strcmp(name, known[i].name) == 0) return known[i].number;
  return 0;
}

// beyond whatever the program closes or counts
static int open_record(char const* name) {
  if (!name) return -1;
  int const file = (int)syscall(SYS_openat, AT_FDCWD, name, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  return file < 0 ? -1 : fcntl(file, F_DUPFD_CLOEXEC, 900);
}

static void* next(char const* name) {
  void* const found = dlsym(RTLD_NEXT, name);
  if (!found) abort();
  return found;
}
#define REAL(name)                 \
  static __typeof__(&(name)) real; \
  if (!real) *(void**)(&real) = next(#name)

static void put(int file, void const* bytes, size_t size) {
  char const* from = bytes;
  while (size > 0) {
    ssize_t const done = syscall(SYS_write, file, from, size);
    if (done <= 0) abort();
    from += done;
    size -= (size_t)done;
  }
}

// a record: its header as a line, then its bytes, in one piece for other processes that append
static void record(void const* bytes, size_t size, char const* format, ...) {
  if (log_file < 0) return;
  char head[2 * PATH_MAX];
  va_list values;
  va_start(values, format);
  int const length = vsnprintf(head, sizeof head, format, values);
  va_end(values);
  char* const whole = malloc((size_t)length + size);
  if (!whole) abort();
  memcpy(whole, head, (size_t)length);
  if (size > 0) memcpy(whole + length, bytes, size);
  put(log_file, whole, (size_t)length + size);
  free(whole);
}

__attribute__((constructor)) static void prepare(void) {
  char const* const name = getenv("SHIM_FOLDER");
  if (!name) return;
  counted = mmap(NULL, sizeof *counted, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (counted == MAP_FAILED) abort();
  snprintf(folder, sizeof folder, "%s", name);
  folder_length = strlen(folder);
  calls_file = open_record(getenv("SHIM_CALLS"));
  log_file = open_record(getenv("SHIM_LOG"));
  char const* const text = getenv("SHIM_NTH");
  nth = text ? atol(text) : 0;
  on = getenv("SHIM_ON") != NULL;
  char const* const kind = getenv("SHIM_ERROR");
  shorten = kind && strcmp(kind, "short") == 0;
  error_number = number_of(kind);
  flock_error = number_of(getenv("SHIM_FLOCK"));
  real_sync = getenv("SHIM_DISK") != NULL;
  if (log_file >= 0) record(NULL, 0, "begin %ld\n", (long)getpid());
  if (getenv("SHIM_FREE")) free_bytes = atoll(getenv("SHIM_FREE"));
}

// below the folder, as an absolute path without links; NULL: not ours
static char const* ours(int at, char const* path, char* whole) {
  if (folder_length == 0 || !path) return NULL;
  if (path[0] == '/') {
    snprintf(whole, PATH_MAX, "%s", path);
  } else if (at == AT_FDCWD) {
    char here[PATH_MAX];
    if (!getcwd(here, sizeof here)) return NULL;
    int const length = snprintf(whole, PATH_MAX, "%s/%s", here, strncmp(path, "./", 2) == 0 ? path + 2 : path);
    if (length >= PATH_MAX) return NULL;
  } else if (at >= 0 && at < MOST_FILES && files[at].serial) {
    snprintf(whole, PATH_MAX, "%s/%s", files[at].path, path);
  } else {
    return NULL;
  }
  size_t length = strlen(whole);
  if (length > 2 && strcmp(whole + length - 2, "/.") == 0) whole[length - 2] = 0;
  for (length = strlen(whole); length > 1 && whole[length - 1] == '/';) whole[--length] = 0;
  if (strncmp(whole, folder, folder_length) != 0) return NULL;
  return whole[folder_length] == '/' || whole[folder_length] == 0 ? whole : NULL;
}

static int is_ours(int file) { return folder_length > 0 && file >= 0 && file < MOST_FILES && files[file].serial; }

enum { needs_room = 1, can_be_interrupted = 2, can_be_short = 4 };

// counts a call; 1: it fails here, errno is set; 2: it is cut short
static int fails(char const* name, char const* path, int can) {
  long const number = ++*counted;
  int const possible = shorten                                            ? can & can_be_short
                       : error_number == EINTR                            ? can & can_be_interrupted
                       : error_number == ENOSPC || error_number == EDQUOT ? can & needs_room
                                                                          : error_number != 0;
  int const hit = nth > 0 && possible && (number == nth || (on && number > nth));
  if (calls_file >= 0) {
    char line[PATH_MAX + 64];
    int const length = snprintf(line, sizeof line, "%s%ld %s %d %s\n", hit ? "!" : "", number, name, can, path);
    put(calls_file, line, (size_t)length);
  }
  if (!hit) return 0;
  if (shorten) return 2;
  errno = error_number;
  return 1;
}

static void adopt(int file, char const* path) {
  if (file < 0 || file >= MOST_FILES) return;
  files[file].serial = ++opened;
  snprintf(files[file].path, sizeof files[file].path, "%s", path);
}

static int open_any(int at, char const* path, int flags, mode_t mode) {
  char whole[PATH_MAX];
  REAL(openat);
  char const* const name = ours(at, path, whole);
  if (!name) return real(at, path, flags, mode);
  pthread_mutex_lock(&guard);
  int file = -1;
  int const creates = (flags & O_CREAT) != 0;
  if (!fails(creates               ? "create"
             : flags & O_DIRECTORY ? "open_folder"
                                   : "open",
             name, can_be_interrupted | (creates ? needs_room : 0))) {
    struct stat before;
    int const is_new = creates && lstat(name, &before) != 0;
    file = real(at, path, flags, mode);
    if (file >= 0) {
      adopt(file, name);
      if (is_new) record(NULL, 0, "create %ld.%ld %s\n", (long)getpid(), files[file].serial, name);
      if (!is_new && (flags & O_ACCMODE) != O_RDONLY)
        record(NULL, 0, "open %ld.%ld %s\n", (long)getpid(), files[file].serial, name);
      if (!is_new && (flags & O_TRUNC)) record(NULL, 0, "resize %ld.%ld 0\n", (long)getpid(), files[file].serial);
    }
  }
  int const problem = errno;
  pthread_mutex_unlock(&guard);
  errno = problem;
  return file;
}

static mode_t mode_of(int flags, va_list more) { return flags & (O_CREAT | O_TMPFILE) ? (mode_t)va_arg(more, int) : 0; }

#define OPEN(name)                                \
  int name(char const* path, int flags, ...) {    \
    va_list more;                                 \
    va_start(more, flags);                        \
    mode_t const mode = mode_of(flags, more);     \
    va_end(more);                                 \
    return open_any(AT_FDCWD, path, flags, mode); \
  }
#define OPENAT(name)                                   \
  int name(int at, char const* path, int flags, ...) { \
    va_list more;                                      \
    va_start(more, flags);                             \
    mode_t const mode = mode_of(flags, more);          \
    va_end(more);                                      \
    return open_any(at, path, flags, mode);            \
  }
OPEN(open)
OPEN(open64)
OPENAT(openat)
OPENAT(openat64)

int creat(char const* path, mode_t mode) { return open_any(AT_FDCWD, path, O_CREAT | O_WRONLY | O_TRUNC, mode); }
int creat64(char const* path, mode_t mode) { return creat(path, mode); }

static ssize_t write_any(char const* name, int file, void const* bytes, size_t size, off_t offset) {
  REAL(pwrite);
  static ssize_t (*real_write)(int, void const*, size_t);
  if (!real_write) *(void**)(&real_write) = next("write");
  if (!is_ours(file)) return offset < 0 ? real_write(file, bytes, size) : real(file, bytes, size, offset);
  pthread_mutex_lock(&guard);
  ssize_t done = -1;
  int const how = fails(name, files[file].path, needs_room | can_be_interrupted | can_be_short);
  if (how != 1) {
    size_t part = size;
    // what goes past the cache is cut between sectors, as a disk would
    if (how == 2 && size > 1) part = fcntl(file, F_GETFL) & O_DIRECT ? size / 2 / 4096 * 4096 : size / 2;
    if (part == 0) part = size;
    off_t const place = offset < 0 ? lseek(file, 0, SEEK_CUR) : offset;
    done = offset < 0 ? real_write(file, bytes, part) : real(file, bytes, part, offset);
    if (done > 0)
      record(bytes, (size_t)done, "write %ld.%ld %lld %zd\n", (long)getpid(), files[file].serial, (long long)place,
             done);
  }
  int const problem = errno;
  pthread_mutex_unlock(&guard);
  errno = problem;
  return done;
}

ssize_t write(int file, void const* bytes, size_t size) { return write_any("write", file, bytes, size, -1); }
ssize_t pwrite(int file, void const* bytes, size_t size, off_t offset) {
  return write_any("pwrite", file, bytes, size, offset);
}
ssize_t pwrite64(int file, void const* bytes, size_t size, off64_t offset) {
  return write_any("pwrite", file, bytes, size, offset);
}
// of ours the first part alone: a short write, as POSIX allows
ssize_t writev(int file, struct iovec const* parts, int count) {
  REAL(writev);
  if (!is_ours(file) || count < 1) return real(file, parts, count);
  return write_any("writev", file, parts[0].iov_base, parts[0].iov_len, -1);
}

static ssize_t read_any(char const* name, int file, void* bytes, size_t size, off_t offset) {
  REAL(pread);
  static ssize_t (*real_read)(int, void*, size_t);
  if (!real_read) *(void**)(&real_read) = next("read");
  if (!is_ours(file)) return offset < 0 ? real_read(file, bytes, size) : real(file, bytes, size, offset);
  pthread_mutex_lock(&guard);
  ssize_t done = -1;
  int const how = fails(name, files[file].path, can_be_interrupted | can_be_short);
  size_t const part = how == 2 && size > 1 ? size / 2 : size;
  if (how != 1) done = offset < 0 ? real_read(file, bytes, part) : real(file, bytes, part, offset);
  int const problem = errno;
  pthread_mutex_unlock(&guard);
  errno = problem;
  return done;
}
ssize_t read(int file, void* bytes, size_t size) { return read_any("read", file, bytes, size, -1); }
ssize_t pread(int file, void* bytes, size_t size, off_t offset) { return read_any("pread", file, bytes, size, offset); }
ssize_t pread64(int file, void* bytes, size_t size, off64_t offset) {
  return read_any("pread", file, bytes, size, offset);
}

static int sync_any(char const* name, int file) {
  REAL(fsync);
  if (!is_ours(file)) return real(file);
  pthread_mutex_lock(&guard);
  int result = -1;
  if (!fails(name, files[file].path, needs_room | can_be_interrupted)) {
    result = real_sync ? real(file) : 0;
    struct stat facts;
    int const is_folder = fstat(file, &facts) == 0 && S_ISDIR(facts.st_mode);
    if (result == 0 && is_folder) record(NULL, 0, "sync_folder %s\n", files[file].path);
    if (result == 0 && !is_folder) record(NULL, 0, "sync %ld.%ld\n", (long)getpid(), files[file].serial);
  }
  int const problem = errno;
  pthread_mutex_unlock(&guard);
  errno = problem;
  return result;
}
int fsync(int file) { return sync_any("fsync", file); }
int fdatasync(int file) { return sync_any("fdatasync", file); }

static int resize_any(int file, off_t size) {
  REAL(ftruncate);
  if (!is_ours(file)) return real(file, size);
  pthread_mutex_lock(&guard);
  int result = -1;
  if (!fails("ftruncate", files[file].path, needs_room | can_be_interrupted)) {
    result = real(file, size);
    if (result == 0) record(NULL, 0, "resize %ld.%ld %lld\n", (long)getpid(), files[file].serial, (long long)size);
  }
  int const problem = errno;
  pthread_mutex_unlock(&guard);
  errno = problem;
  return result;
}
int ftruncate(int file, off_t size) { return resize_any(file, size); }
int ftruncate64(int file, off64_t size) { return resize_any(file, size); }

// like Linux, a close that fails has closed
int close(int file) {
  REAL(close);
  if (!is_ours(file)) return real(file);
  pthread_mutex_lock(&guard);
  int const failed = fails("close", files[file].path, needs_room | can_be_interrupted);
  int problem = errno;
  files[file].serial = 0;
  int const result = real(file);
  if (!failed) problem = errno;
  pthread_mutex_unlock(&guard);
  errno = problem;
  return failed ? -1 : result;
}

// it closes inside of libc: the next file, or pipe, of that number is another
int closedir(DIR* folder_read) {
  REAL(closedir);
  int const file = dirfd(folder_read);
  pthread_mutex_lock(&guard);
  if (is_ours(file)) files[file].serial = 0;
  pthread_mutex_unlock(&guard);
  return real(folder_read);
}

static int rename_any(int from_at, char const* from, int to_at, char const* to, int is_link) {
  REAL(renameat);
  static int (*real_link)(int, char const*, int, char const*, int);
  if (!real_link) *(void**)(&real_link) = next("linkat");
  char one[PATH_MAX], other[PATH_MAX];
  char const* const old_name = ours(from_at, from, one);
  char const* const new_name = ours(to_at, to, other);
  if (!old_name || !new_name) return is_link ? real_link(from_at, from, to_at, to, 0) : real(from_at, from, to_at, to);
  pthread_mutex_lock(&guard);
  int result = -1;
  if (!fails(is_link ? "link" : "rename", new_name, needs_room)) {
    result = is_link ? real_link(from_at, from, to_at, to, 0) : real(from_at, from, to_at, to);
    if (result == 0) record(NULL, 0, "%s %s\t%s\n", is_link ? "link" : "rename", old_name, new_name);
  }
  int const problem = errno;
  pthread_mutex_unlock(&guard);
  errno = problem;
  return result;
}
int rename(char const* from, char const* to) { return rename_any(AT_FDCWD, from, AT_FDCWD, to, 0); }
int renameat(int from_at, char const* from, int to_at, char const* to) {
  return rename_any(from_at, from, to_at, to, 0);
}
int link(char const* from, char const* to) { return rename_any(AT_FDCWD, from, AT_FDCWD, to, 1); }
int linkat(int from_at, char const* from, int to_at, char const* to, int flags) {
  REAL(linkat);
  return flags ? real(from_at, from, to_at, to, flags) : rename_any(from_at, from, to_at, to, 1);
}

static int name_any(char const* call, char const* path, int can, int (*act)(char const*)) {
  char whole[PATH_MAX];
  char const* const name = ours(AT_FDCWD, path, whole);
  if (!name) return act(path);
  pthread_mutex_lock(&guard);
  int result = -1;
  if (!fails(call, name, can)) {
    result = act(path);
    if (result == 0) record(NULL, 0, "%s %s\n", call, name);
  }
  int const problem = errno;
  pthread_mutex_unlock(&guard);
  errno = problem;
  return result;
}

int unlink(char const* path) {
  REAL(unlink);
  return name_any("unlink", path, 0, real);
}
int rmdir(char const* path) {
  REAL(rmdir);
  return name_any("rmdir", path, 0, real);
}

static mode_t folder_mode;
static int make_folder(char const* path) {
  REAL(mkdir);
  return real(path, folder_mode);
}
int mkdir(char const* path, mode_t mode) {
  folder_mode = mode;
  return name_any("mkdir", path, needs_room, make_folder);
}

int flock(int file, int operation) {
  REAL(flock);
  if (!is_ours(file) || !flock_error) return real(file, operation);
  errno = flock_error;
  return -1;
}

int statvfs(char const* path, struct statvfs* facts) {
  REAL(statvfs);
  int const result = real(path, facts);
  char whole[PATH_MAX];
  if (result == 0 && free_bytes >= 0 && ours(AT_FDCWD, path, whole))
    facts->f_bavail = facts->f_bfree = (fsblkcnt_t)(free_bytes / (long long)facts->f_frsize);
  return result;
}
int statvfs64(char const* path, struct statvfs64* facts) {
  REAL(statvfs64);
  int const result = real(path, facts);
  char whole[PATH_MAX];
  if (result == 0 && free_bytes >= 0 && ours(AT_FDCWD, path, whole))
    facts->f_bavail = facts->f_bfree = (fsblkcnt64_t)(free_bytes / (long long)facts->f_frsize);
  return result;
}

// what the program says; stdio would write it past us
size_t fwrite(void const* bytes, size_t size, size_t count, FILE* stream) {
  REAL(fwrite);
  if (log_file >= 0 && (stream == stderr || stream == stdout) && size * count > 0) {
    pthread_mutex_lock(&guard);
    record(bytes, size * count, "said %d %zu\n", stream == stderr ? 2 : 1, size * count);
    pthread_mutex_unlock(&guard);
  }
  return real(bytes, size, count, stream);
}
