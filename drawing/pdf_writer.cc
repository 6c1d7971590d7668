// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "drawing/pdf_writer.h"

#include "scene/formats/image_io.h"
#include "scene/formats/text_encoding.h"
#include "scene/text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <string_view>

namespace groundglass {
namespace {

constexpr double kPointsPerMm = 72 / 25.4;
constexpr double kMaxPagePoints = 14400;

// Four decimals: a ten-thousandth of a millimetre. PDF has no exponents, which FormatNumber writes
// of small numbers.
std::string Pdf(double value) {
  std::array<char, 400> digits;
  const auto end = std::to_chars(
      digits.data(), digits.data() + digits.size(), value, std::chars_format::fixed, 4);
  std::string text(digits.data(), end.ptr);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}
std::string Pdf(const Eigen::Vector2d& point) { return Pdf(point.x()) + " " + Pdf(point.y()); }
std::string Ref(int object) { return std::to_string(object) + " 0 R"; }

std::string Escaped(const std::string& bytes) {
  std::string text = "(";
  for (const char c : bytes) {
    if (c == '(' || c == ')' || c == '\\') text += '\\';
    text += c == '\n' || c == '\r' ? ' ' : c;
  }
  return text + ")";
}

// What readers show outside the page, in fonts of their own: ASCII, or else UTF-16 as digits
// (7.9.2).
std::string PdfTextString(const std::string& utf8) {
  if (std::all_of(utf8.begin(), utf8.end(), [](char c) { return c >= ' ' && c < 0x7f; })) {
    return Escaped(utf8);
  }
  std::string text = "<";
  for (const char c : Utf16FromUtf8(utf8)) {
    constexpr std::string_view kDigits = "0123456789ABCDEF";
    const auto byte = static_cast<unsigned char>(c);
    text += kDigits[byte >> 4];
    text += kDigits[byte & 15];
  }
  return text + ">";
}

}  // namespace

PdfPage::PdfPage(const ByteSink& append, double width_mm, double height_mm)
    : append_(append), width_mm_(width_mm), height_mm_(height_mm) {
  // The second line says that the file is binary.
  Append("%PDF-1.7\n%\xe2\xe3\xcf\xd3\n");
}

void PdfPage::Append(std::string_view bytes) {
  append_(bytes);
  size_ += bytes.size();
}

int PdfPage::Reserve() {
  offsets_.push_back(0);
  return static_cast<int>(offsets_.size());
}

void PdfPage::WriteObject(int number, const std::string& body) {
  offsets_[number - 1] = size_;
  Append(std::to_string(number) + " 0 obj\n" + body + "\nendobj\n");
}

void PdfPage::WriteStream(int number, const std::string& dictionary, std::string_view bytes) {
  offsets_[number - 1] = size_;
  Append(std::to_string(number) + " 0 obj\n<< " + dictionary + " /Length " +
         std::to_string(bytes.size()) + " >>\nstream\n");
  Append(bytes);
  Append("\nendstream\nendobj\n");
}

int PdfPage::AddLayer(const std::string& name, bool is_shown) {
  const int object = Reserve();
  WriteObject(object, "<< /Type /OCG /Name " + PdfTextString(name) + " >>");
  layers_.push_back({object, is_shown});
  return static_cast<int>(layers_.size()) - 1;
}

void PdfPage::BeginLayer(int layer) { content_ += "/OC /L" + std::to_string(layer) + " BDC\n"; }
void PdfPage::EndLayer() { content_ += "EMC\n"; }

void PdfPage::DrawPicture(const Image8& srgb8,
                          const Eigen::Vector2d& low_mm,
                          const Eigen::Vector2d& size_mm,
                          int quality) {
  ImageWriteOptions options;
  options.jpeg_quality = quality;
  const std::vector<uint8_t> jpeg = EncodeImage(srgb8, ".jpg", options);
  const int object = Reserve();
  WriteStream(object,
              "/Type /XObject /Subtype /Image /Width " + std::to_string(srgb8.width) + " /Height " +
                  std::to_string(srgb8.height) +
                  " /ColorSpace /DeviceRGB /BitsPerComponent 8 /Filter /DCTDecode",
              AsText(jpeg));
  content_ += "q " + Pdf(size_mm.x()) + " 0 0 " + Pdf(size_mm.y()) + " " + Pdf(low_mm) + " cm /P" +
              std::to_string(pictures_.size()) + " Do Q\n";
  pictures_.push_back(object);
}

void PdfPage::SetPen(double width_mm, double grey) {
  content_ += Pdf(width_mm) + " w " + Pdf(grey) + " G 1 J\n";
}
void PdfPage::SetFill(double red, double green, double blue) {
  content_ += Pdf(red) + " " + Pdf(green) + " " + Pdf(blue) + " rg\n";
}
void PdfPage::DrawLine(const Eigen::Vector2d& start_mm, const Eigen::Vector2d& end_mm) {
  content_ += Pdf(start_mm) + " m " + Pdf(end_mm) + " l S\n";
}
void PdfPage::FillRectangle(const Eigen::Vector2d& low_mm, const Eigen::Vector2d& size_mm) {
  content_ += Pdf(low_mm) + " " + Pdf(size_mm) + " re f\n";
}
void PdfPage::FillTriangle(const Eigen::Vector2d& a_mm,
                           const Eigen::Vector2d& b_mm,
                           const Eigen::Vector2d& c_mm) {
  content_ += Pdf(a_mm) + " m " + Pdf(b_mm) + " l " + Pdf(c_mm) + " l f\n";
}
void PdfPage::DrawText(const Eigen::Vector2d& baseline_mm,
                       double size_mm,
                       const std::string& utf8) {
  // The font's encoding is WinAnsi, which is Windows-1252.
  content_ += "BT /F1 " + Pdf(size_mm) + " Tf " + Pdf(baseline_mm) + " Td " +
              Escaped(Windows1252FromUtf8(utf8, unshown_)) + " Tj ET\n";
}

void PdfPage::SetMeasure(const Eigen::Vector2d& low_mm,
                         const Eigen::Vector2d& size_mm,
                         double scale) {
  const double unit =
      std::max(1.0, std::max(width_mm_, height_mm_) * kPointsPerMm / kMaxPagePoints);
  const Eigen::Vector2d low = low_mm * kPointsPerMm / unit;
  const Eigen::Vector2d high = (low_mm + size_mm) * kPointsPerMm / unit;
  char metres_per_unit[32];
  std::snprintf(
      metres_per_unit, sizeof metres_per_unit, "%.9f", scale * unit / kPointsPerMm / 1000);
  const std::string number =
      std::string("[<< /Type /NumberFormat /U (m) /C ") + metres_per_unit + " /D 1000 >>]";
  viewport_ = "/VP [<< /Type /Viewport /BBox [" + Pdf(low) + " " + Pdf(high) +
              "] /Measure << /Type /Measure /Subtype /RL /R (1:" + FormatNumber(scale) + ") /X " +
              number +
              " /D [<< /Type /NumberFormat /U (m) /C 1 /D 1000 >>]"
              " /A [<< /Type /NumberFormat /U (m2) /C 1 /D 100 >>] >> >>]";
}

std::string PdfPage::PageBody(int content) const {
  const double longest = std::max(width_mm_, height_mm_) * kPointsPerMm;
  const double unit = std::max(1.0, longest / kMaxPagePoints);
  std::string body = "<< /Type /Page /Parent " + Ref(static_cast<int>(offsets_.size()) - 1) +
                     " /MediaBox [0 0 " + Pdf(width_mm_ * kPointsPerMm / unit) + " " +
                     Pdf(height_mm_ * kPointsPerMm / unit) + "]";
  if (unit > 1) body += " /UserUnit " + Pdf(unit);
  body += " /Contents " + Ref(content) +
          " /Resources << /Font << /F1 << /Type /Font /Subtype /Type1 /BaseFont /Helvetica "
          "/Encoding /WinAnsiEncoding >> >> /XObject <<";
  for (size_t i = 0; i < pictures_.size(); ++i) {
    body += " /P" + std::to_string(i) + " " + Ref(pictures_[i]);
  }
  body += " >> /Properties <<";
  for (size_t i = 0; i < layers_.size(); ++i) {
    body += " /L" + std::to_string(i) + " " + Ref(layers_[i].object);
  }
  return body + " >> >> " + viewport_ + " >>";
}

std::string PdfPage::CatalogBody(int pages) const {
  std::string all;
  std::string hidden;
  for (const Layer& layer : layers_) {
    all += Ref(layer.object) + " ";
    if (!layer.is_shown) hidden += Ref(layer.object) + " ";
  }
  return "<< /Type /Catalog /Pages " + Ref(pages) + " /OCProperties << /OCGs [" + all +
         "] /D << /Order [" + all + "] /OFF [" + hidden + "] >> >> >>";
}

void PdfPage::Finish(const std::string& title) {
  const double unit =
      std::max(1.0, std::max(width_mm_, height_mm_) * kPointsPerMm / kMaxPagePoints);
  const int content = Reserve();
  char scale[64];
  std::snprintf(
      scale, sizeof scale, "%.9f 0 0 %.9f 0 0 cm\n", kPointsPerMm / unit, kPointsPerMm / unit);
  WriteStream(content, "", scale + content_);
  const int pages = Reserve();
  const int page = Reserve();
  WriteObject(page, PageBody(content));
  WriteObject(pages, "<< /Type /Pages /Count 1 /Kids [" + Ref(page) + "] >>");
  const int catalog = Reserve();
  WriteObject(catalog, CatalogBody(pages));
  const int info = Reserve();
  WriteObject(info, "<< /Title " + PdfTextString(title) + " /Producer (groundglass) >>");
  const size_t start = size_;
  std::string table = "xref\n0 " + std::to_string(offsets_.size() + 1) + "\n0000000000 65535 f \n";
  for (const size_t offset : offsets_) {
    char line[32];
    std::snprintf(line, sizeof line, "%010zu 00000 n \n", offset);
    table += line;
  }
  Append(table + "trailer\n<< /Size " + std::to_string(offsets_.size() + 1) + " /Root " +
         Ref(catalog) + " /Info " + Ref(info) + " >>\nstartxref\n" + std::to_string(start) +
         "\n%%EOF\n");
}

}  // namespace groundglass
