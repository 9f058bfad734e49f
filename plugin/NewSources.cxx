// SPDX-License-Identifier: BSD-3-Clause
#include "NewSources.h"

#include "pqApplicationCore.h"
#include "pqObjectBuilder.h"
#include "pqPipelineSource.h"
#include "vtkBoundingBox.h"
#include "vtkPVDataInformation.h"
#include "vtkSMDoubleVectorProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMPropertyIterator.h"
#include "vtkSMProxy.h"
#include "vtkSMProxySelectionModel.h"
#include "vtkSMRepresentationProxy.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMTrace.h"
#include "vtkSmartPointer.h"

#include <QCoreApplication>
#include <QTimer>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

namespace
{

/// The sources' default extents; what is visible and less than this many times larger or smaller
/// is a model that they fit.
constexpr double kDefaultSize = 2.0;
constexpr double kMostTimes = 10.0;
/// Part of the visible diagonal that a placed source has.
constexpr double kShare = 0.125;

vtkSMProxy* activeView(vtkSMProxy* source)
{
  auto* model = source->GetSessionProxyManager()->GetSelectionModel("ActiveView");
  return model ? model->GetCurrentProxy() : nullptr;
}

vtkBoundingBox visibleBounds(vtkSMProxy* view)
{
  vtkBoundingBox bounds;
  const vtkSMPropertyHelper shown(view, "Representations", true);
  for (unsigned int k = 0; k < shown.GetNumberOfElements(); ++k)
  {
    auto* proxy = vtkSMRepresentationProxy::SafeDownCast(shown.GetAsProxy(k));
    if (!proxy || !vtkSMPropertyHelper(proxy, "Visibility", true).GetAsInt())
    {
      continue;
    }
    double box[6];
    proxy->GetRepresentedDataInformation()->GetBounds(box);
    if (vtkBoundingBox::IsValid(box))
    {
      bounds.AddBounds(box);
    }
  }
  return bounds;
}

bool fitsDefaults(const vtkBoundingBox& seen)
{
  const double diagonal = seen.GetDiagonalLength();
  vtkBoundingBox around(seen);
  around.Inflate(diagonal);
  const double origin[3] = { 0.0, 0.0, 0.0 };
  return diagonal < kMostTimes * kDefaultSize && kMostTimes * diagonal > kDefaultSize &&
    around.ContainsPoint(origin) != 0;
}

/// The nearest of 1, 2, 5, 10, 20, ...
double roundNumber(double value)
{
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  const double digits = value / power;
  return power * (digits < 1.5 ? 1.0 : digits < 3.5 ? 2.0 : digits < 7.5 ? 5.0 : 10.0);
}

/// The axis that points most nearly up in the view: 0, 1 or 2, and whether it does so backwards.
int upwards(vtkSMProxy* view, bool& down)
{
  double up[3] = { 0.0, 1.0, 0.0 };
  if (view->GetProperty("CameraViewUp"))
  {
    vtkSMPropertyHelper(view, "CameraViewUp").Get(up, 3);
  }
  const double* most =
    std::max_element(up, up + 3, [](double a, double b) { return std::abs(a) < std::abs(b); });
  down = *most < 0.0;
  return static_cast<int>(most - up);
}

bool startsWith(const std::string& name, const char* start)
{
  return name.compare(0, std::strlen(start), start) == 0;
}

/// Points of the shape, in world coordinates.
bool isPlace(const std::string& name)
{
  return name == "Center" || name == "Origin" || startsWith(name, "Point");
}

/// Lengths, in world units.
bool isLength(const std::string& name)
{
  return name == "Lengths" || name.find("Radi") != std::string::npos;
}

void moveAndScale(vtkSMProxy* source, double scale, const double to[3])
{
  const auto property = vtkSmartPointer<vtkSMPropertyIterator>::Take(source->NewPropertyIterator());
  for (property->Begin(); !property->IsAtEnd(); property->Next())
  {
    auto* values = vtkSMDoubleVectorProperty::SafeDownCast(property->GetProperty());
    const std::string name = property->GetKey();
    if (!values || values->GetIsInternal() || values->GetInformationOnly() ||
      (!isPlace(name) && !isLength(name)))
    {
      continue;
    }
    for (unsigned int k = 0; k < values->GetNumberOfElements(); ++k)
    {
      const double moved = isPlace(name) ? to[k % 3] : 0.0;
      values->SetElement(k, moved + scale * values->GetElement(k));
    }
  }
  source->UpdateVTKObjects();
}

void place(pqPipelineSource* source)
{
  vtkSMProxy* const proxy = source->getProxy();
  vtkSMProxy* const view = activeView(proxy);
  if (!view || !startsWith(proxy->GetXMLName(), "HybridTree"))
  {
    return;
  }
  const vtkBoundingBox seen = visibleBounds(view);
  if (!seen.IsValid() || !(seen.GetDiagonalLength() > 0.0) || fitsDefaults(seen))
  {
    return;
  }
  const double scale = roundNumber(kShare * seen.GetDiagonalLength());
  double to[3];
  seen.GetCenter(to);
  bool down = false;
  const int axis = upwards(view, down);
  to[axis] = down ? seen.GetMinPoint()[axis] : seen.GetMaxPoint()[axis];
  const double step = 0.1 * scale;
  for (double& coordinate : to)
  {
    coordinate = step * std::round(coordinate / step);
  }
  SM_SCOPED_TRACE(PropertiesModified).arg("proxy", proxy);
  moveAndScale(proxy, scale, to);
}

void connectToGui()
{
  static bool connected = false; // plugins may be loaded again
  auto* application = pqApplicationCore::instance();
  if (application && !connected)
  {
    pqObjectBuilder* builder = application->getObjectBuilder();
    QObject::connect(builder, &pqObjectBuilder::sourceCreated, builder, &place);
    connected = true;
  }
}

} // namespace

void placeNewSources()
{
  if (QCoreApplication::instance())
  {
    // The plugin may be loaded while the GUI is still being set up.
    QTimer::singleShot(0, QCoreApplication::instance(), &connectToGui);
  }
}
