#pragma once

#include <array>
#include <string_view>

/// The readers of files as fuzzers see them. Each takes any bytes as the content of a file, may throw sessile::Error
/// and nothing else, and ends the program where what was read contradicts what the reader promises.
namespace sessile::fuzz {

void read_scene_json(std::string_view bytes);
void read_overrides(std::string_view bytes);  ///< a `--set` in each line
void read_method_json(std::string_view bytes);
void read_mesh_obj(std::string_view bytes);
void read_mesh_stl(std::string_view bytes);
void read_mesh_ply(std::string_view bytes);
void read_frame_ply(std::string_view bytes);
void read_frame_vtp(std::string_view bytes);
void read_results(std::string_view bytes);     ///< as scene.json, summary.json and frames.pvd of a folder
void read_checkpoint(std::string_view bytes);  ///< the content of a checkpoint, not compressed, behind a right checksum
void read_checkpoint_file(std::string_view bytes);
void read_session(std::string_view bytes);  ///< the JSON that a checkpoint holds of the program
void read_surface_index(std::string_view bytes);
void read_usda(std::string_view bytes);        ///< a surface over time that a writer goes on with
void read_usda_parts(std::string_view bytes);  ///< the files that one left when it was killed, between lines of "----"
void read_verdict(std::string_view bytes);

struct Target {
  std::string_view name;  ///< of its folders below corpus/ and regressions/
  void (*read)(std::string_view bytes);
};

inline constexpr std::array<Target, 16> targets{{{"scene", read_scene_json},
                                                 {"overrides", read_overrides},
                                                 {"method", read_method_json},
                                                 {"mesh_obj", read_mesh_obj},
                                                 {"mesh_stl", read_mesh_stl},
                                                 {"mesh_ply", read_mesh_ply},
                                                 {"frame_ply", read_frame_ply},
                                                 {"frame_vtp", read_frame_vtp},
                                                 {"results", read_results},
                                                 {"checkpoint", read_checkpoint},
                                                 {"checkpoint_file", read_checkpoint_file},
                                                 {"session", read_session},
                                                 {"surface_index", read_surface_index},
                                                 {"usda", read_usda},
                                                 {"usda_parts", read_usda_parts},
                                                 {"verdict", read_verdict}}};

/// Calls the reader; errors that it may throw are well.
void survive(void (*read)(std::string_view), std::string_view bytes);

/// Ends the program with a sentence unless `right`: what libFuzzer and a test both see as a finding.
void must(bool right, std::string_view what);

}  // namespace sessile::fuzz
