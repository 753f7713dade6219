#pragma once

namespace tamp::runtime
{

/// How the page of a graph looks and what it does, as they stand in it.
extern const char* const graph_page_style;
extern const char* const graph_page_script;

}  // namespace tamp::runtime
