#include <iostream>

#include "messages/schema.h"

int main() { std::cout << ensonify::msg::reference_page(); }
