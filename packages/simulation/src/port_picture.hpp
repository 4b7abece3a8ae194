/// Pictures of ports.
#pragma once

#include <culm/model/model.hpp>
#include <culm/port/port.hpp>

#include <filesystem>
#include <string>

namespace culm::simulation {

/// The file of a port in a folder of results.
std::string port_picture(const std::string& name);

/// Writes the points of a port in the reference as a VTU file. Throws FileError.
void draw_port(const port::Port& port, const model::Model& model,
               const std::filesystem::path& path);

}  // namespace culm::simulation
