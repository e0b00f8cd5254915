#include "core/robot_files/module_manual.h"

#include "core/robot_files/module_keys.h"
#include "core/settings/schema_fields.h"
#include "core/settings/wording.h"

namespace gaitlab {

std::vector<KeyRow> module_rows() {
  Explainer rows(true);
  ModuleKeys().fields(rows);
  return rows.rows();
}

std::string explain_module_file() {
  return wrapped(
             "A module file describes a type of module: a tree of bodies and revolute hinges, with docking faces, contact "
             "elements, a motor and a controller. `gaitlab new module NAME` writes one to start from; `gaitlab explain module "
             "NAME` prints the parts of a module, a file or one of `gaitlab list module`.") +
         "\n" + table(module_rows());
}

std::string module_page() {
  return "# The module file\n\n"
         "<!-- Written by `tests/gates/reference.sh build/release --renew`; CI fails where it is stale. -->\n\n"
         "Every key, as `gaitlab explain module` prints it; their use: [modules](../modules.md). `gaitlab new module NAME` "
         "writes a\nfile to start from. For editors: the JSON Schema `scenarios/gaitlab-module.schema.json`, by `gaitlab "
         "schema "
         "--module`.\n\n" +
         markdown_table(module_rows());
}

Json module_type_schema() {
  SchemaFields schema;
  ModuleKeys().fields(schema);
  return schema.object();
}

}  // namespace gaitlab
