#pragma once
// Tests that only `make soak` runs, because `make test` has too little time for them. GoogleTest leaves out tests whose
// names begin with DISABLED_, and says how many; scripts/soak has it run these as well.

#define SOAK_TEST(suite, name) TEST(suite, DISABLED_##name)
#define SOAK_TEST_F(fixture, name) TEST_F(fixture, DISABLED_##name)
