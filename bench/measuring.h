/* What the benchmarks share: a clock, repetition, and tables of CSV on standard output.
 *
 * What is compared runs in turns: a round runs every case once, and the next round the other way about, so
 * that a machine that is busy, or slows down as it warms, does so for all of them. The least time of many
 * rounds says what the code costs; the median says what one gets.
 *
 * A benchmark that cannot do its work, or whose contestants disagree about it, ends the program. */
#ifndef BENCH_MEASURING_H
#define BENCH_MEASURING_H

#include <stddef.h>
#include <stdint.h>

#include "chart/rounds.h"
#include "sbfmt/base.h"

/* Processor time of the calling thread: what else a busy machine does meanwhile does not count. Files are in
 * the page cache, so that loads do not wait. */
static inline double bench_now_s(void) {
  return chart_now_s();
}

/* Ends the program with a message; with the text of `error` where `status` is none of success. */
_Noreturn void bench_fail(const char *format, ...);
void bench_require(sbf_status status, const sbf_diagnostic *error);
void *bench_allocate(size_t count, size_t size);

typedef chart_spread bench_spread;
/* Of at least one sample; sorts them. */
static inline bench_spread bench_spread_of(double *samples, uint32_t count) {
  return chart_spread_of(samples, count);
}

typedef chart_timed bench_case;
/* Runs all cases `rounds` times, after one round that does not count. */
void bench_rounds(bench_case *cases, uint32_t case_count, uint32_t rounds);

/* Prints the head of a table: `columns`, then those that say where and when a row was measured. */
void bench_print_columns(const char *columns);
/* Prints a row: the formatted fields, separated by commas, then commit, compiler, lanes, processor, date. */
void bench_print_row(const char *format, ...);

/* Whether an argument of main is `--quick`: every case once or so, to see that the program works. Takes note
 * of `--once` as well: every row with the figures that do not depend on the machine, times of one round, no
 * other engines. */
bool bench_is_quick(int argument_count, char **arguments);
/* Whether `--once` or `--quick` was given. */
bool bench_runs_once(void);
/* `rounds`, or 1 where bench_runs_once. */
uint32_t bench_round_count(uint32_t rounds);

#endif
