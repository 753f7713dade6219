#pragma once

#include "tools/run/drive/course.hpp"
#include "tools/run/drive/laboratory_test.hpp"
#include "tools/run/drive/mixed_path.hpp"
#include "tools/run/drive/path.hpp"

namespace tamp::tools
{

/// Takes a fresh point of a material along a path. Each segment is cut into equal increments of time, as few as keep
/// the strain of each (its norm) within `largest_strain`, and the superposed rotation within 0.1 rad; sand accepts
/// strains up to 0.2. Throws SimulationError, with the time and the row that was being approached, where the material
/// fails.
void drive(const tasks::SceneMaterial& material, const DeformationPath& path, double largest_strain,
           const ShowPoint& show);

/// As above, with stress prescribed in part. The point is first taken, unseen, from fresh material to the stress of the
/// first row, along a straight line in stress; what gives way to stress begins as in the identity. Increments are
/// halved where they strain more or no stress is found, and doubled after one that strains less than half of that.
/// Throws SimulationError, also with the stress reached and wanted, where the material cannot follow in 1e-9 of a
/// segment, or fails to thousands of times, as it does beyond its strength.
void drive(const tasks::SceneMaterial& material, const MixedPath& path, double largest_strain, const ShowPoint& show);

/// As above, with the start of a laboratory test in place of the first row, and then along the test.
void drive(const tasks::SceneMaterial& material, const LaboratoryTest& test, double largest_strain,
           const ShowPoint& show);

}  // namespace tamp::tools
