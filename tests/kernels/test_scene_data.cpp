#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "device_test.h"
#include "scene/scene_data.h"
#include "scene_data_members.h"

using namespace device_test;

namespace {

struct Member {
  std::string of, name;
  int offset, size;
};

#define SIZE(type) static_cast<int>(sizeof(type)),
#define NAME(type) #type,
#define MEMBER(type, member)                                                                                 \
  {#type, #member, static_cast<int>(offsetof(type, member)), static_cast<int>(sizeof(type::member))},
const std::vector<int> host_sizes{SHARED_STRUCTS(SIZE)};
const std::vector<std::string> struct_names{SHARED_STRUCTS(NAME)};
const std::vector<Member> host_members{SHARED_MEMBERS(MEMBER)};

} // namespace

TEST_CASE("scene_data: the list of members is complete, and no struct has padding") {
  std::map<std::string, int> end;
  for (const Member& member : host_members) {
    CAPTURE(member.of, member.name);
    CHECK(member.offset == end[member.of]);
    CHECK(member.size % 4 == 0); // GATHER_REAL counts 4-byte words
    end[member.of] = member.offset + member.size;
  }
  for (std::size_t i = 0; i < host_sizes.size(); ++i) CHECK(end[struct_names[i]] == host_sizes[i]);
}

TEST_CASE("scene_data: host and device agree about sizes and offsets") {
  for (const Variant v : variants) {
    CAPTURE(v);
    const Program program(v, read_file("scene_data_members.h") + read_file("scene_data.cl"));
    std::vector<int> sizes(host_sizes.size()), offsets(host_members.size()),
        member_sizes(host_members.size());
    std::vector<char> memory(1024);
    program.run("sizes", 1, table(sizes));
    program.run("offsets", 1, table(memory), table(offsets), table(member_sizes));
    CHECK(sizes == host_sizes);
    for (std::size_t i = 0; i < host_members.size(); ++i) {
      CAPTURE(host_members[i].of, host_members[i].name);
      CHECK(offsets[i] == host_members[i].offset);
      CHECK(member_sizes[i] == host_members[i].size);
    }
  }
}
