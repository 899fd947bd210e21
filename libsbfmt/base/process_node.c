/* Child process of a program in WebAssembly: another program of the same kind, run by another Node.js or, in
 * a browser, by the same worker. There are no limits of processor time and address space; WebAssembly has at
 * most 4 GiB. */
#include <emscripten.h>

#include "base/process.h"

enum { CANNOT_RUN = -1 };

/* Runs the program and keeps its result in Module.child until release_child. Returns an sbfi_process_end, or
 * CANNOT_RUN. Module.runProgram is in tools/node/program_head.js, for a browser in
 * runtime/hosts/studio/program_worker.js. */
EM_JS(int, run_child, (const char *const *words, double wall_ms, double output_bytes), {
  const list = [];
  for (let at = words >> 2; HEAP32[at]; at++) list.push(UTF8ToString(HEAP32[at]));
  Module.child = Module.runProgram(list, wall_ms, output_bytes);
  return Module.child.end;
})

EM_JS(int, child_status, (void), { return Module.child.status || 0; })
EM_JS(int, child_signal, (void), { return Module.child.signal || 0; })
EM_JS(double, child_output_size, (void), { return Module.child.output.length; })
EM_JS(void, copy_child_output, (void *to), { HEAPU8.set(Module.child.output, to); })
/* The last `size` bytes of its standard error, or why it could not be run. */
EM_JS(int, copy_child_words, (char *to, int size), {
  const bytes = Module.child.words;
  const last = bytes.subarray(Math.max(0, bytes.length - size));
  HEAPU8.set(last, to);
  return last.length;
})
EM_JS(void, release_child, (void), { delete Module.child; })

static sbf_status take_result(int end, sbfi_process_result *result, sbf_diagnostic *error) {
  char tail[SBFI_PROCESS_ERROR_TAIL];
  double size = child_output_size();
  sbfi_process_copy_tail(tail, (size_t)copy_child_words(tail, sizeof tail), result->error_tail);
  if (end == CANNOT_RUN)
    return sbfi_diagnose(error, SBF_CODE_IO_CANNOT_RUN, "cannot run the program: %s", result->error_tail);
  result->end = (sbfi_process_end)end;
  result->exit_status = end == SBFI_PROCESS_EXITED ? child_status() : 0;
  result->signal = end == SBFI_PROCESS_EXITED ? 0 : child_signal();
  if (size == 0) return SBF_OK;
  if (size < (double)SIZE_MAX) result->output = sbfi_allocate(&result->allocator, (size_t)size);
  if (!result->output)
    return sbfi_diagnose(error, SBF_CODE_OUT_OF_MEMORY, "no memory to keep a program's output");
  result->output_size = result->output_capacity = (size_t)size;
  copy_child_output(result->output);
  return SBF_OK;
}

sbf_status sbfi_process_run(const char *const *arguments, const sbfi_process_limits *limits,
    const sbf_allocator *allocator, sbfi_process_result *result, sbf_diagnostic *error) {
  *result = (sbfi_process_result){.allocator = sbfi_allocator_or_default(allocator)};
  int end = run_child(arguments, limits->wall_ms, (double)limits->output_bytes);
  sbf_status status = take_result(end, result, error);
  release_child();
  return status;
}
