// The fuzzer's inputs, replayed by any compiler.
#include "fuzz/asset_corpus.h"
#include "support/folders.h"

namespace rubble::test {
namespace {

class AssetCorpus : public testing::Test {
 protected:
  AssetCorpus() {
    m_folder = std::filesystem::path(testing::TempDir()) /
               (std::string("rubble_fuzz_") + testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(m_folder);
  }
  ~AssetCorpus() override { std::filesystem::remove_all(m_folder); }

  bool loads(const std::string& bytes) const {
    return loadsAsAsset({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()},
                        m_folder / "input.asset");
  }

  const std::filesystem::path m_corpus = sourceFolder() + "/tests/fuzz/asset_corpus";
  std::filesystem::path m_folder;
};

// Files that begin with "found" are inputs that once did harm; all others are made.
TEST_F(AssetCorpus, IsWhatItsMakerWrites) {
  std::map<std::string, std::string> there;
  std::uintmax_t bytes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(m_corpus)) {
    bytes += entry.file_size();
    const std::string name = entry.path().filename().string();
    if (!name.starts_with("found")) there[name] = bytesOf(entry.path());
  }
  EXPECT_TRUE(there == assetCorpus(m_folder / "scratch"))
      << "run: build/release/tests/fuzz/rubble_asset_corpus tests/fuzz/asset_corpus";
  EXPECT_LT(bytes, 50'000u);
}

TEST_F(AssetCorpus, IsLoadedOrRefused) {
  for (const auto& entry : std::filesystem::directory_iterator(m_corpus)) {
    const std::string name = entry.path().filename().string();
    SCOPED_TRACE(name);
    std::string bytes = bytesOf(entry.path());
    const bool isDamaged = name.starts_with("damaged");
    const bool isLoaded = loads(bytes);
    sealAsset({reinterpret_cast<std::uint8_t*>(bytes.data()), bytes.size()});
    const bool isSealedLoaded = loads(bytes);
    if (name.starts_with("found")) continue;
    EXPECT_EQ(isLoaded, !isDamaged);
    EXPECT_EQ(isSealedLoaded, !isDamaged || name == "damaged_checksum");
  }
}

}  // namespace
}  // namespace rubble::test
