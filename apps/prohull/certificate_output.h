#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "inputs.h"
#include "outputs.h"
#include "prohull/certificate.h"

namespace prohull::cli {

/// --certificate of a command whose outputs `what` names: "the hull". `limits` are sentences that follow.
CLI::Option* add_certificate_option(CLI::App& command, std::filesystem::path& file, const std::string& what,
                                    const std::string& limits = "");

/// Files of meshes that prohull_check reads.
inline const std::vector<std::string> kCheckable{".stl", ".obj", ".ply", ".off"};

/// Before any work, if there is to be a certificate: throws InputError(InvalidOption) for an original that
/// prohull_check does not read, and for an output whose name ends in `suffix`, if that is none of `checkable`.
void check_certified(const std::filesystem::path& certificate, const std::filesystem::path& original,
                     const std::string& suffix, const std::vector<std::string>& checkable = kCheckable);

/// The mesh that was read from `path`, if there is to be a certificate; otherwise nothing.
CertifiedOriginal certified_original(const std::filesystem::path& certificate, const TriangleMesh& mesh,
                                     const std::filesystem::path& path, const InputOptions& options);

/// A line of the summary: what the certificate claims, and the command that checks it.
void print_certificate(const std::filesystem::path& file, const Certificate& certificate,
                       const std::vector<std::filesystem::path>& hull, const std::filesystem::path& original);

}  // namespace prohull::cli
