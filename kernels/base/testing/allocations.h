#pragma once

/// Number of calls of operator new in this test program: linking allocations.cpp replaces it.
long allocations();
