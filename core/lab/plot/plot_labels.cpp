#include "core/lab/plot/plot_labels.h"

#include <algorithm>
#include <numeric>

namespace flexcast {
namespace {

// Labels that have to stay on top of each other, moved as one.
struct Stack {
  std::size_t first = 0, count = 0;
  double sum = 0.0;  // of the wanted places of its first label

  double place() const { return sum / static_cast<double>(count); }
};

// Columns of labels: numbers of boxes whose horizontal extents are connected.
std::vector<std::vector<std::size_t>> find_columns(const std::vector<SvgBox>& boxes) {
  std::vector<std::size_t> order(boxes.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return boxes[a].left < boxes[b].left; });
  std::vector<std::vector<std::size_t>> columns;
  double right = 0.0;
  for (const std::size_t i : order) {
    if (columns.empty() || boxes[i].left >= right) {
      columns.emplace_back();
      right = boxes[i].right;
    }
    columns.back().push_back(i);
    right = std::max(right, boxes[i].right);
  }
  return columns;
}

// Pool adjacent violators: least squares under the condition that each is below the one before it (M. Ayer et al.,
// Annals of Mathematical Statistics 26, 1955), all labels as high as the highest.
void spread_column(std::vector<SvgBox>& boxes, std::vector<std::size_t> column, double top, double bottom) {
  std::stable_sort(column.begin(), column.end(), [&](auto a, auto b) { return boxes[a].top < boxes[b].top; });
  double height = 0.0;
  for (const std::size_t i : column) height = std::max(height, boxes[i].bottom - boxes[i].top);
  std::vector<Stack> stacks;
  for (std::size_t k = 0; k < column.size(); ++k) {
    stacks.push_back({k, 1, boxes[column[k]].top - static_cast<double>(k) * height});
    while (stacks.size() > 1 && stacks[stacks.size() - 2].place() >= stacks.back().place()) {
      const Stack last = stacks.back();
      stacks.pop_back();
      stacks.back().count += last.count;
      stacks.back().sum += last.sum;
    }
  }
  const double lowest = bottom - static_cast<double>(column.size()) * height;
  for (const Stack& stack : stacks) {
    for (std::size_t k = stack.first; k < stack.first + stack.count; ++k) {
      SvgBox& box = boxes[column[k]];
      const double size = box.bottom - box.top;
      box.top = std::max(std::min(stack.place(), lowest), std::min(top, lowest)) + static_cast<double>(k) * height;
      box.bottom = box.top + size;
    }
  }
}

bool is_inside(const SvgBox& box, const SvgBox& bounds) {
  return box.left >= bounds.left && box.right <= bounds.right && box.top >= bounds.top && box.bottom <= bounds.bottom;
}

}  // namespace

void spread_labels(std::vector<SvgBox>& boxes, double top, double bottom) {
  for (const auto& column : find_columns(boxes)) spread_column(boxes, column, top, bottom);
}

SvgBox find_note_place(SvgPoint mark, double width, double height, const SvgBox& bounds,
                       const std::vector<SvgBox>& taken) {
  const auto place = [&](double left, double top) { return SvgBox{left, top, left + width, top + height}; };
  const SvgBox first = place(mark.x - 0.5 * width, mark.y - 6.0 - height);
  for (const double gap : {6.0, 14.0, 24.0}) {
    const double above = mark.y - gap - height, below = mark.y + gap, middle = mark.y - 0.5 * height;
    const double right = mark.x + gap, left = mark.x - gap - width, center = mark.x - 0.5 * width;
    for (const SvgBox& box : {place(center, above), place(right, middle), place(left, middle), place(center, below),
                              place(right, above), place(left, below), place(right, below), place(left, above)}) {
      if (!is_inside(box, bounds)) continue;
      if (std::none_of(taken.begin(), taken.end(), [&](const SvgBox& other) { return box.overlaps(other); }))
        return box;
    }
  }
  return first;
}

}  // namespace flexcast
