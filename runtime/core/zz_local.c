typedef int sbri_nothing;
