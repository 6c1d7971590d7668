// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace groundglass {

// An element of an XML file. Names come without their prefix ("gml:pos" is "pos"): the formats that
// are read here have no name twice. Entities are resolved; comments, instructions and document
// types are skipped, and nothing outside the file is ever looked at.
struct XmlElement {
  std::string name;
  std::map<std::string, std::string> attributes;
  std::string text;  // all of its own, not that of its children
  std::vector<XmlElement> children;
  int line = 0;  // where it starts, from 1

  // The first child of this name; null if there is none.
  const XmlElement* Child(std::string_view child_name) const;
  // Its text without blanks at the ends; empty if there is no such child.
  std::string ChildText(std::string_view child_name) const;
  // An attribute's value; empty if it has none.
  std::string Attribute(const std::string& attribute_name) const;
};

// The root element. Throws Error naming file and line for what is no well-formed XML, and for
// elements nested more than 200 deep.
XmlElement ReadXml(const std::filesystem::path& file);

// "FILE:LINE", for messages.
std::string XmlPlace(const std::filesystem::path& file, const XmlElement& element);

// Numbers parted by blanks. Throws Error naming file and line for a word that is none.
std::vector<double> ReadXmlNumbers(const std::filesystem::path& file,
                                   const XmlElement& element,
                                   std::string_view text);

}  // namespace groundglass
