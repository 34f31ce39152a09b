#pragma once

/// How often this test program has called operator new: linking allocations.cpp replaces it.
long allocations();
