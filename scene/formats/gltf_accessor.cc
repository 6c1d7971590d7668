// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/gltf_accessor.h"

#include <algorithm>
#include <cstring>

namespace groundglass {
namespace {

// Elements of an accessor that has no bytes of its own; more would only fill memory with zeros.
constexpr size_t kMostZeros = size_t{1} << 24;

// A run of elements in a buffer.
struct Elements {
  const unsigned char* begin = nullptr;
  size_t stride = 0;
};

class AccessorReader {
 public:
  AccessorReader(const tinygltf::Model& gltf, const std::filesystem::path& file)
      : gltf_(gltf), file_(file) {}

  std::vector<double> Read(int index, int width) const {
    const tinygltf::Accessor& accessor = GltfItem(gltf_.accessors, index, "accessor", file_);
    const int components = tinygltf::GetNumComponentsInType(static_cast<uint32_t>(accessor.type));
    if (components != width) FailGltf(file_, "an accessor has the wrong type");
    const size_t num_values = accessor.count * static_cast<size_t>(width);
    std::vector<double> values;
    if (accessor.bufferView >= 0) {
      const size_t size = ComponentSize(accessor.componentType);
      const Elements elements = Find(accessor.bufferView,
                                     accessor.byteOffset,
                                     size * static_cast<size_t>(width),
                                     accessor.count);
      values.reserve(num_values);
      for (size_t i = 0; i < accessor.count; ++i) {
        for (int c = 0; c < width; ++c) {
          values.push_back(Component(elements.begin + i * elements.stride + c * size,
                                     accessor.componentType,
                                     accessor.normalized));
        }
      }
    } else {
      if (accessor.count > kMostZeros) FailGltf(file_, "an accessor without bytes is too long");
      values.assign(num_values, 0);
    }
    if (accessor.sparse.isSparse) PutExceptions(accessor, width, values);
    return values;
  }

 private:
  size_t ComponentSize(int type) const {
    const int size = tinygltf::GetComponentSizeInBytes(static_cast<uint32_t>(type));
    if (size < 1) FailGltf(file_, "an accessor has the wrong type");
    return static_cast<size_t>(size);
  }

  Elements Find(int view_index, size_t offset, size_t element, size_t count) const {
    const tinygltf::BufferView& view =
        GltfItem(gltf_.bufferViews, view_index, "buffer view", file_);
    const tinygltf::Buffer& buffer = GltfItem(gltf_.buffers, view.buffer, "buffer", file_);
    const size_t stride = view.byteStride > 0 ? view.byteStride : element;
    const size_t available = buffer.data.size();
    if (view.byteOffset > available || offset > available - view.byteOffset || stride < element) {
      FailGltf(file_, "an accessor reaches beyond its buffer");
    }
    const size_t begin = view.byteOffset + offset;
    if (count > 0 &&
        (element > available - begin || count - 1 > (available - begin - element) / stride)) {
      FailGltf(file_, "an accessor reaches beyond its buffer");
    }
    return {buffer.data.data() + begin, stride};
  }

  double Component(const unsigned char* at, int type, bool is_normalised) const {
    const auto read = [at](auto value) {
      std::memcpy(&value, at, sizeof(value));
      return static_cast<double>(value);
    };
    // Both ends of the signed types are -1.
    const auto scaled = [&](double value, double most) {
      return is_normalised ? std::max(value / most, -1.0) : value;
    };
    switch (type) {
      case TINYGLTF_COMPONENT_TYPE_FLOAT:
        return read(float{});
      case TINYGLTF_COMPONENT_TYPE_DOUBLE:  // not of the format, but some write it
        return read(double{});
      case TINYGLTF_COMPONENT_TYPE_BYTE:
        return scaled(read(int8_t{}), 127);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return scaled(read(uint8_t{}), 255);
      case TINYGLTF_COMPONENT_TYPE_SHORT:
        return scaled(read(int16_t{}), 32767);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return scaled(read(uint16_t{}), 65535);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return read(uint32_t{});
      default:
        FailGltf(file_, "an accessor has a type that is not supported");
    }
  }

  void PutExceptions(const tinygltf::Accessor& accessor,
                     int width,
                     std::vector<double>& values) const {
    const auto& sparse = accessor.sparse;
    if (sparse.count < 0) FailGltf(file_, "a sparse accessor is damaged");
    const size_t count = static_cast<size_t>(sparse.count);
    const size_t index_size = ComponentSize(sparse.indices.componentType);
    const size_t value_size = ComponentSize(accessor.componentType);
    const size_t element = value_size * static_cast<size_t>(width);
    const Elements indices = Find(sparse.indices.bufferView,
                                  static_cast<size_t>(sparse.indices.byteOffset),
                                  index_size,
                                  count);
    const Elements exceptions = Find(
        sparse.values.bufferView, static_cast<size_t>(sparse.values.byteOffset), element, count);
    for (size_t i = 0; i < count; ++i) {
      const double place =
          Component(indices.begin + i * indices.stride, sparse.indices.componentType, false);
      if (!(place >= 0 && place < static_cast<double>(accessor.count))) {
        FailGltf(file_, "a sparse accessor names an element that there is not");
      }
      for (int c = 0; c < width; ++c) {
        values[static_cast<size_t>(place) * static_cast<size_t>(width) + static_cast<size_t>(c)] =
            Component(
                exceptions.begin + i * exceptions.stride + static_cast<size_t>(c) * value_size,
                accessor.componentType,
                accessor.normalized);
      }
    }
  }

  const tinygltf::Model& gltf_;
  const std::filesystem::path& file_;
};

}  // namespace

void FailGltf(const std::filesystem::path& file, const std::string& message) {
  throw Error(file, "cannot read this glTF model: " + message);
}

std::vector<double> ReadGltfAccessor(const tinygltf::Model& gltf,
                                     int index,
                                     int width,
                                     const std::filesystem::path& file) {
  return AccessorReader(gltf, file).Read(index, width);
}

}  // namespace groundglass
