// The implementation alone; two_files_b.c and two_files_b.cpp use it.
#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"
