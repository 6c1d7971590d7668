// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/formats/atomic_file.h"
#include "scene/image.h"

#include <Eigen/Dense>

#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace groundglass {

// One page of PDF 1.7 at true scale, written piece by piece, so that pictures need not fit into
// memory. Places are millimetres on the page, x to the right and y up from its lower left corner.
//
// ISO 32000-1: layers are optional content groups (8.11), the scale is a rectilinear measure in a
// viewport (12.9), and pages beyond 5.08 m count in larger units (UserUnit).
class PdfPage {
 public:
  // append: takes the file's bytes in order.
  PdfPage(const ByteSink& append, double width_mm, double height_mm);

  // What is drawn next belongs to this layer, which the reader can turn on and off.
  int AddLayer(const std::string& name, bool is_shown);
  void BeginLayer(int layer);
  void EndLayer();

  // An RGB picture into a rectangle. JPEG inside: lossy at `quality`; without one, Deflate would
  // be needed, so flat colours are best given a high quality.
  void DrawPicture(const Image8& srgb8,
                   const Eigen::Vector2d& low_mm,
                   const Eigen::Vector2d& size_mm,
                   int quality);
  void SetPen(double width_mm, double grey);
  void SetFill(double red, double green, double blue);
  void DrawLine(const Eigen::Vector2d& start_mm, const Eigen::Vector2d& end_mm);
  void FillRectangle(const Eigen::Vector2d& low_mm, const Eigen::Vector2d& size_mm);
  void FillTriangle(const Eigen::Vector2d& a_mm,
                    const Eigen::Vector2d& b_mm,
                    const Eigen::Vector2d& c_mm);
  // Helvetica; what it has not (UnshownCharacters) becomes '?'. size_mm: of the font, about 1.4
  // capitals.
  void DrawText(const Eigen::Vector2d& baseline_mm, double size_mm, const std::string& utf8);

  const std::set<std::string>& UnshownCharacters() const { return unshown_; }

  // What readers' measuring tools say inside a rectangle: metres on the building.
  void SetMeasure(const Eigen::Vector2d& low_mm, const Eigen::Vector2d& size_mm, double scale);

  // Writes what remains. Once, at the end.
  void Finish(const std::string& title);

 private:
  int Reserve();
  void WriteObject(int number, const std::string& body);
  void WriteStream(int number, const std::string& dictionary, std::string_view bytes);
  void Append(std::string_view bytes);
  std::string PageBody(int content) const;
  std::string CatalogBody(int pages) const;

  const ByteSink& append_;
  double width_mm_;
  double height_mm_;
  size_t size_ = 0;              // of the file so far
  std::vector<size_t> offsets_;  // of objects, from number 1
  std::vector<int> pictures_;    // their objects
  struct Layer {
    int object = 0;
    bool is_shown = true;
  };
  std::vector<Layer> layers_;
  std::string content_;
  std::string viewport_;
  std::set<std::string> unshown_;
};

}  // namespace groundglass
