// A program that does nothing: what is tested is that it links (tests/CMakeLists.txt).
int main() { return 0; }
