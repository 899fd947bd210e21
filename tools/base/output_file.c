#include "base/output_file.h"

#include <stdlib.h>
#include <string.h>

#include "base/fault.h"

void output_file_release(output_file *output) {
  free(output->final_path);
  free(output->written_path);
  *output = (output_file){0};
}

sbf_status output_file_refuse(output_file *output, int why, sbf_diagnostic *diagnostic) {
  sbf_status status = fault_set_file(diagnostic, SBF_CODE_IO_CANNOT_WRITE, output->given,
      "cannot write: %s; check the folder, its permissions and the free space", strerror(why));
  output_file_release(output);
  return status;
}

sbf_status output_file_no_memory(output_file *output, sbf_diagnostic *diagnostic) {
  sbf_status status =
      fault_set_file(diagnostic, SBF_CODE_OUT_OF_MEMORY, output->given, "no memory for a file's name");
  output_file_release(output);
  return status;
}
