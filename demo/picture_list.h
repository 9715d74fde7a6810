// Which files in a folder of pictures are a run's own, so that the next run removes these and no others.
#pragma once

#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "demo/output_file.h"

namespace rubble::demo {

/// The file rubble_pictures.txt in a folder: a head line, then one name a line. Whoever edits it cannot make
/// a run touch anything else: only regular files of that folder count that are named as a run names its
/// pictures (pictureName) or its movie.
class PictureList {
 public:
  /// Reads the list in `folder`, if there is one. `movie` is the name of this scene's movie. Throws
  /// InputError when a file of the list's name is no list of ours.
  PictureList(std::filesystem::path folder, std::string movie);

  /// Throws InputError when one of the first `frames` pictures or the movie would replace a file that is not
  /// listed.
  void requireFree(int frames) const;
  /// Removes the pictures and the movie that are listed, and begins a new list. Throws MachineError.
  void startAnew();
  /// Lists a file that is about to be written. Needs startAnew() before. Throws MachineError.
  void add(const std::string& name);

  static constexpr const char* kName = "rubble_pictures.txt";

 private:
  void read();
  bool isOurs(const std::filesystem::path& file) const;

  std::filesystem::path m_folder;
  std::string m_movie;
  std::set<std::string> m_listed;          // pictures, the movie, and their .part
  std::vector<std::string> m_otherMovies;  // of other scenes in the same folder: they stay, and stay listed
  std::unique_ptr<OutputFile> m_file;
};

/// Name of a frame's picture in its folder.
std::string pictureName(int frame);

}  // namespace rubble::demo
