// The implementation alone; two_files_b.c and two_files_b.cpp use it. The header comes first without
// and then twice with SUBDIV_IMPLEMENTATION, as happens when several headers of a project include
// it: one implementation. Behind headers that define common words as macros, as those of Windows
// do.
#define near
#define far
#define small char
#define interface struct
#define min(a, b) ((a) < (b) ? (a) : (b))
#define max(a, b) ((a) > (b) ? (a) : (b))
#define IN
#define OUT
#define VOID void
#define CONST const
#define ERROR 0
#define DELETE 0x00010000L
#define RGB(r, g, b) ((r) | (g) << 8 | (b) << 16)
#include "subdiv.h"
#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"
#include "subdiv.h"
