// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Volume_TetrahedralMesh_h
#define meniscus_Volume_TetrahedralMesh_h

namespace meniscus
{
}

#endif
