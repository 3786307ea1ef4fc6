#include "verbs.h"

namespace seiche {

const std::vector<AddVerb>& verbs() {
  static const std::vector<AddVerb> table{add_run,        add_resume, add_check,  add_validate, add_info,
                                          add_render,     add_plot,   add_export, add_init,     add_help,
                                          add_completion, add_manual, add_schema};
  return table;
}

}  // namespace seiche
