// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** Methods of filters for ParaView whose refracting surfaces have a table of interfaces. */
#ifndef SurfaceGathering_h
#define SurfaceGathering_h

#include "InterfaceTable.h"

/** Members that the two declaring macros below share; begins and ends with private ones. */
#define meniscusGatheringMembers(className, requestExtent)                                         \
public:                                                                                            \
  static className* New();                                                                         \
  meniscusInterfaceTableDeclarations();                                                            \
                                                                                                   \
protected:                                                                                         \
  className();                                                                                     \
  ~className() override;                                                                           \
  int FillInputPortInformation(int port, vtkInformation* info) override;                           \
  int requestExtent(vtkInformation* request, vtkInformationVector** inputs,                        \
    vtkInformationVector* outputs) override;                                                       \
  int RequestData(vtkInformation* request, vtkInformationVector** inputs,                          \
    vtkInformationVector* outputs) override;                                                       \
                                                                                                   \
private:                                                                                           \
  className(const className&) = delete;                                                            \
  void operator=(const className&) = delete;                                                       \
  meniscus::InterfaceTable Table

/**
 * Declares in a class, after `private:`, what meniscusSurfaceGatheringMacro defines. The argument
 * is the method by which the superclass requests its inputs.
 */
#define meniscusSurfaceGatheringDeclarations(className, requestExtent)                             \
public:                                                                                            \
  void SetExactMembrane(vtkImplicitFunction* function);                                            \
  meniscusGatheringMembers(className, requestExtent)

/**
 * Defines the methods of a class whose surfaces are at an input port: every rank gathers them from
 * all ranks and blocks, in the order of the table, and runs the superclass with them.
 */
#define meniscusSurfaceGatheringMacro(className, requestExtent, surfacePort, isOptional)           \
  vtkStandardNewMacro(className);                                                                  \
  meniscusInterfaceTableMacro(className);                                                          \
  className::className()                                                                           \
  {                                                                                                \
    this->SetInterfaces(this->Table.GetInterfaces());                                              \
  }                                                                                                \
  className::~className() = default;                                                               \
  void className::SetExactMembrane(vtkImplicitFunction* function)                                  \
  {                                                                                                \
    this->Table.SetExactSurface(function);                                                         \
  }                                                                                                \
  int className::FillInputPortInformation(int port, vtkInformation* info)                          \
  {                                                                                                \
    const int filled = this->Superclass::FillInputPortInformation(port, info);                     \
    if (port == (surfacePort))                                                                     \
    {                                                                                              \
      meniscus::AcceptComposite(info);                                                             \
    }                                                                                              \
    return filled;                                                                                 \
  }                                                                                                \
  int className::requestExtent(                                                                    \
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)         \
  {                                                                                                \
    const int succeeded = this->Superclass::requestExtent(request, inputs, outputs);               \
    meniscus::AskForPiece(inputs[surfacePort], outputs);                                           \
    return succeeded;                                                                              \
  }                                                                                                \
  int className::RequestData(                                                                      \
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)         \
  {                                                                                                \
    std::string fault;                                                                             \
    const auto surfaces = this->Table.GatherSurfaces(inputs[surfacePort], isOptional, fault);      \
    if (!surfaces)                                                                                 \
    {                                                                                              \
      vtkErrorMacro(<< fault << "; the output is empty.");                                         \
      return 0;                                                                                    \
    }                                                                                              \
    vtkInformationVector* ports[] = { inputs[0], inputs[0], nullptr };                             \
    ports[surfacePort] = surfaces;                                                                 \
    const int succeeded = this->Superclass::RequestData(request, ports, outputs);                  \
    if ((surfacePort) == 0) /* the output is that of the surfaces alone */                         \
    {                                                                                              \
      meniscus::KeepOutputOfFirstRank(outputs);                                                    \
    }                                                                                              \
    return succeeded;                                                                              \
  }                                                                                                \
  static_assert(true, "")

/** Declares in a class, after `private:`, what meniscusBlockPortsMacro defines, and the rest. */
#define meniscusBlockPortsDeclarations(className, requestExtent)                                   \
public:                                                                                            \
  int ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,                       \
    vtkInformationVector* outputs) override;                                                       \
  int FillOutputPortInformation(int port, vtkInformation* info) override;                          \
  meniscusGatheringMembers(className, requestExtent)

/**
 * Defines the methods, except the constructor, of a class whose first input may have blocks and
 * whose second has surfaces. The output has the blocks of the input. Each rank requests its part of
 * the surfaces, and runs the superclass with all of them for each of its blocks of the given type;
 * before, all ranks run the statement `prepare`.
 */
#define meniscusBlockPortsMacro(className, requestExtent, blockType, prepare)                      \
  vtkStandardNewMacro(className);                                                                  \
  meniscusInterfaceTableMacro(className);                                                          \
  className::~className() = default;                                                               \
  int className::FillInputPortInformation(int port, vtkInformation* info)                          \
  {                                                                                                \
    const int filled = this->Superclass::FillInputPortInformation(port, info);                     \
    meniscus::AcceptComposite(info);                                                               \
    return filled;                                                                                 \
  }                                                                                                \
  int className::FillOutputPortInformation(int vtkNotUsed(port), vtkInformation* info)             \
  {                                                                                                \
    info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkDataObject");                                   \
    return 1;                                                                                      \
  }                                                                                                \
  int className::ProcessRequest(                                                                   \
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)         \
  {                                                                                                \
    if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA_OBJECT()))                              \
    {                                                                                              \
      return meniscus::MakeOutputLikeInput(inputs[0], outputs);                                    \
    }                                                                                              \
    return this->Superclass::ProcessRequest(request, inputs, outputs);                             \
  }                                                                                                \
  int className::requestExtent(                                                                    \
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)         \
  {                                                                                                \
    const int succeeded = this->Superclass::requestExtent(request, inputs, outputs);               \
    meniscus::AskForPiece(inputs[1], outputs);                                                     \
    return succeeded;                                                                              \
  }                                                                                                \
  int className::RequestData(                                                                      \
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)         \
  {                                                                                                \
    std::string fault;                                                                             \
    const auto surfaces = this->Table.GatherSurfaces(inputs[1], false, fault);                     \
    if (!surfaces)                                                                                 \
    {                                                                                              \
      vtkErrorMacro(<< fault << "; the output is empty.");                                         \
      return 0;                                                                                    \
    }                                                                                              \
    prepare;                                                                                       \
    return meniscus::RunBlocks(blockType, inputs, outputs, surfaces,                               \
      [this, request](vtkInformationVector** ports, vtkInformationVector* output)                  \
      { return this->Superclass::RequestData(request, ports, output); });                          \
  }                                                                                                \
  static_assert(true, "")

#endif
