// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include "foreign_point.h"

/// The point types that the typed tests run over.
using OrientedPointTypes = ::testing::Types<pcl::PointNormal, pcl::PointXYZINormal, ForeignPoint>;
