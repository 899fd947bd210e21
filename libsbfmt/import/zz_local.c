typedef int sbfi_nothing;
