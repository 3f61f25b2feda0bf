#pragma once
// Reads the fields that node_fields.h lists from an element.

#include "documents/field_reader.h"
#include "documents/node_fields.h"

namespace imgeo {

/// Reads a node from an element; absent fields have the defaults of `Node`.
template <typename Node> Node readNode(const FieldReader& fields) {
  struct Read {
    const FieldReader& fields;
    void operator()(const char* name, std::string& member, Written = {}) { member = fields.text(name); }
    void operator()(const char* name, bool& member, Written = {}) { member = fields.boolean(name, member); }
    void operator()(const char* name, float& member, Written = {}) { member = fields.real(name, member); }
    void operator()(const char* name, double& member, Written = {}) { member = fields.real(name, member); }
    void operator()(const char* name, Vec2f& member, Written = {}) { member = fields.vec2(name, member); }
    void operator()(const char* name, Vec3f& member, Written = {}) { member = fields.vec3(name, member); }
    void operator()(const char* name, Vec3d& member, Written = {}) { member = fields.vec3(name, member); }
    void operator()(const char* name, Rotation& member, Written = {}) { member = fields.rotation(name, member); }
    void line() {} // groups of attributes matter to the writer only
  };
  Node node;
  visitFields(node, Read{fields});
  return node;
}

} // namespace imgeo
