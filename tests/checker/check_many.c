/* prohull_check for many small files: reads lines of the paths CERTIFICATE, HULL and ORIGINAL with tabs between them,
   and answers each with what prohull_check prints, an empty line, and its exit code. Each runs in a process of its own,
   but no program is loaded for it. */
#define _POSIX_C_SOURCE 200809L
#define main check
#include "checker/prohull_check.c"
#undef main
#include <sys/wait.h>
#include <unistd.h>

enum { LONGEST = 60 }; /* seconds */

static int answer(char* line) {
  char* names[] = {"prohull_check", strtok(line, "\t\n"), strtok(NULL, "\t\n"), strtok(NULL, "\t\n")};
  alarm(LONGEST);
  dup2(STDOUT_FILENO, STDERR_FILENO);
  return check(4, names);
}

int main(void) {
  static char line[4096];
  while (fgets(line, sizeof line, stdin)) {
    const pid_t child = fork();
    if (child == 0) return answer(line);
    int status = -1;
    waitpid(child, &status, 0);
    printf("\nexit %d\n", WIFEXITED(status) ? WEXITSTATUS(status) : -1);
    fflush(stdout);
  }
  return 0;
}
