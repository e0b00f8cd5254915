// Plugin that was built for a different version of gaitlab.
extern "C" const char* gaitlab_abi() { return "gaitlab-0, cc 1, libc 1"; }
extern "C" void gaitlab_register(void*) {}
