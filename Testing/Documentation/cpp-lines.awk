# A test of each block of C++ in a page. It says the block's own line when it does not compile.
/^```cpp/ { printf "TEST_F(Guide, Block%d)\n{\n#line %d \"%s\"\n", ++blocks, FNR + 1, FILENAME; inside = 1; next }
/^```/ && inside { print "}"; inside = 0 }
inside
