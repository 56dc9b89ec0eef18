// Linked into programs built with sanitizers: libraries that are loaded stay until the process ends, so that a leak in a
// driver or in a validation layer still has the library's name, by which tools/sanitize.supp knows it.
extern "C" int dlclose(void*) {
    return 0;
}
