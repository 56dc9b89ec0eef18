// The table of fields is complete and is what the pages describe.
#include "renderer/scene/fields.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <set>

namespace cutis {
namespace {

std::string pageAt(const char* path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

void expectDescribed(const std::vector<FieldGroup>& groups, const std::string& page) {
    ASSERT_FALSE(page.empty());
    for (const FieldGroup& group : groups)
        for (const Field& field : group.fields)
            EXPECT_TRUE(page.find('`' + std::string(field.key) + '`') != page.npos ||
                        page.find('"' + std::string(field.key) + '"') != page.npos)
                << field.key;
}

TEST(Fields, RigPageHasEveryKey) {
    expectDescribed(rigFields(), pageAt(CUTIS_RIG_PAGE));
}
TEST(Fields, ScenePageHasEveryKey) {
    expectDescribed(skinFields(), pageAt(CUTIS_SCENE_PAGE));
}

TEST(Fields, EachSaysWhatItIs) {
    std::vector<FieldGroup> groups = rigFields();
    for (FieldGroup& group : skinFields()) groups.push_back(group);
    std::size_t count = 0;
    for (const FieldGroup& group : groups) {
        std::set<std::string> keys;
        for (const Field& field : group.fields) {
            ++count;
            EXPECT_TRUE(keys.insert(field.key).second) << field.key << " twice";
            EXPECT_NE(std::string(field.help), "") << field.key;
            EXPECT_NE(field.allowed(), "") << field.key;
            // What a control covers is what a file may hold.
            if (field.high > field.low) {
                EXPECT_GE(field.low / field.shownPerUnit, field.min) << field.key;
                EXPECT_LE(field.high / field.shownPerUnit, field.max + 1e-9) << field.key;
            }
        }
    }
    EXPECT_GT(count, 30u);
}

TEST(Fields, RangesAreForPeople) {
    EXPECT_EQ(fields::kDistance.allowed(), "above 0 to 1e+06 m");
    EXPECT_EQ(fields::kMix.allowed(), "0 to 1");
    EXPECT_EQ(fields::kShadow.allowed(), "true or false");
    EXPECT_EQ(fields::kSize.allowed(), "two numbers, 0 to 1e+06 m");
}

}  // namespace
}  // namespace cutis
