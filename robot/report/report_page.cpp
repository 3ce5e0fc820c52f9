#include "robot/report/report_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <span>

#include "prohull/detail/base64.h"
#include "prohull/error.h"
#include "robot/files/xml.h"
#include "robot/motion/bodies.h"
#include "robot/motion/joint_limits.h"
#include "robot/report/pictures.h"
#include "robot/report/report_facts.h"

namespace prohull::robot {
namespace {

constexpr const char* kDash = "–";
constexpr int kWide = 880, kHigh = 660;  // of the picture of the robot
constexpr std::string_view kGrey = "#d9d6d1", kBlue = "#7db4ea", kOrange = "#f09a4e", kRed = "#d4483b";  // of pictures

// ---------------------------------------------------------------------------------------------------------------------
// Pictures

struct PagePictures {
  std::string robot;
  std::vector<std::vector<std::string>> cards;  // those of pictures_of_card, for each link
};

TriangleMesh in_link(const LinkHulls& hulls, const TriangleMesh& mesh) {
  return hulls.frame.in_link == Pose{} ? mesh : placed(hulls.frame.in_link, mesh);
}

/// What stands for the boxes, cylinders and so on of a link, in the frame of the link.
TriangleMesh primitives_of(const Link& link, Geometry from) {
  TriangleMesh mesh;
  for (const Shape& shape : shapes(link, from))
    if (!shape.mesh() && !std::holds_alternative<OtherForm>(shape.form))
      append(mesh, placed(shape.origin, form_mesh(shape.form, Curved::Around)));
  return mesh;
}

/// The geometry of a link, and what is around it, in the frame of the link.
Picture picture_of_link(const ReportInput& input, std::size_t link) {
  Picture picture;
  const LinkHulls* const hulls = hulls_of(input, link);
  const LinkCheck* const check = check_of(input, link);
  if (hulls && first_hull(*hulls)) {
    picture.inside = in_link(*hulls, hulls->triangles);
    picture.around = in_link(*hulls, first_hull(*hulls)->mesh);
  } else if (check) {
    picture.inside = check->visual;
    if (!hulls) picture.around = check->collision;
  }
  if (hulls) append(picture.inside, primitives_of(input.file.robot.links[link], input.from));
  return picture;
}

Picture picture_of_robot(const ReportInput& input) {
  const Robot& robot = input.file.robot;
  std::vector<TriangleMesh> inside, around;
  for (std::size_t i = 0; i < robot.links.size(); ++i) {
    Picture link = picture_of_link(input, i);
    inside.push_back(std::move(link.inside));
    around.push_back(std::move(link.around));
  }
  return {at_rest(robot, inside), at_rest(robot, around), input.hulls.empty() ? Shell::Shipped : Shell::Hull, {}};
}

/// The pictures of a card: its hulls, then what was shipped.
std::vector<Picture> pictures_of_card(const ReportInput& input, std::size_t link) {
  std::vector<Picture> pictures;
  if (const LinkHulls* const hulls = hulls_of(input, link))
    for (const LinkHull& hull : hulls->hulls)
      pictures.push_back({in_link(*hulls, hulls->triangles), in_link(*hulls, hull.mesh), Shell::Hull, {}});
  if (const LinkCheck* const check = check_of(input, link); check && check->collision.face_count() > 0) {
    const bool leaks = check->sticks_out_at_least > 0;
    pictures.push_back(
        {check->visual, check->collision, Shell::Shipped, leaks ? std::optional(check->worst_point) : std::nullopt});
  }
  return pictures;
}

PagePictures drawn_pictures(const ReportInput& input, const PageOptions& options) {
  PagePictures drawn{{}, std::vector<std::vector<std::string>>(input.file.robot.links.size())};
  if (!options.pictures) return drawn;
  std::size_t done = 0;
  const auto tell = [&, steps = static_cast<double>(1 + drawn.cards.size())](double fraction) {
    return !options.progress || options.progress("draw", (static_cast<double>(done) + fraction) / steps);
  };
  const auto draw = [&](const std::vector<Picture>& pictures, PictureOptions how) {
    how.threads = options.threads, how.cache = options.cache;
    if (options.progress) how.progress = [&](std::string_view, double fraction) { return tell(fraction); };
    std::vector<std::string> files = draw_pictures(pictures, how);
    if (!tell(1)) throw Cancelled();
    ++done;
    return files;
  };
  drawn.robot = draw({picture_of_robot(input)}, {.width = kWide, .height = kHigh, .lines = false}).front();
  for (std::size_t i = 0; i < drawn.cards.size(); ++i) drawn.cards[i] = draw(pictures_of_card(input, i), {});
  return drawn;
}

// ---------------------------------------------------------------------------------------------------------------------
// Elements

/// Texts of the robot are escaped before they come here.
std::string figure(const std::string& png, std::string_view alt, std::string_view caption, const PictureOptions& size) {
  if (png.empty()) return {};
  return fmt::format(
      "<figure><img src=\"data:image/png;base64,{}\" width=\"{}\" height=\"{}\" alt=\"{}\">"
      "<figcaption>{}</figcaption></figure>\n",
      to_base64(png), size.width, size.height, alt, caption);
}

std::string list(std::string_view title, const std::vector<std::string>& sentences) {
  if (sentences.empty()) return {};
  std::string items;
  for (const std::string& sentence : sentences) items += fmt::format("<li>{}</li>", html_escaped(sentence));
  return fmt::format("<h4>{}</h4>\n<ul class=\"notes\">{}</ul>\n", title, items);
}

/// A cell of a table; what is good or bad has a class of that name.
struct Cell {
  Cell(std::string shown, std::string_view of_class = {}) : text(std::move(shown)), kind(of_class) {}
  Cell(const char* shown) : text(shown) {}
  std::string text;
  std::string_view kind;
};

std::string row(const std::string& head, const std::vector<Cell>& cells) {
  std::string text = fmt::format("<tr><th scope=\"row\">{}</th>", head);
  for (const auto& [shown, kind] : cells)
    text += fmt::format("<td{}>{}</td>", kind.empty() ? "" : fmt::format(" class=\"{}\"", kind), shown);
  return text + "</tr>\n";
}

std::string table(std::string_view caption, const std::vector<std::string>& heads, const std::string& rows) {
  std::string columns;
  for (const std::string& head : heads)
    columns += head.empty() ? "<td></td>" : fmt::format("<th scope=\"col\">{}</th>", head);
  return fmt::format("<div class=\"wide\"><table>{}<thead><tr>{}</tr></thead>\n<tbody>\n{}</tbody></table></div>\n",
                     caption.empty() ? "" : fmt::format("<caption>{}</caption>", caption), columns, rows);
}

std::string name_of_link(const ReportInput& input, std::size_t link) {
  return html_escaped(input.file.robot.links[link].name);
}

/// A link without any geometry has none: the table says all that is known of it.
bool has_card(const ReportInput& input, std::size_t link) {
  const LinkHulls* const hulls = hulls_of(input, link);
  const LinkCheck* const check = check_of(input, link);
  return (hulls && hulls->status != LinkStatus::Empty) || (check && check->verdict != CheckVerdict::NoVisual);
}

std::string link_to(const ReportInput& input, std::size_t link) {
  if (!has_card(input, link)) return name_of_link(input, link);
  return fmt::format("<a href=\"#link-{}\">{}</a>", link, name_of_link(input, link));
}

// ---------------------------------------------------------------------------------------------------------------------
// The top of the page

std::string findings(const ReportInput& input) {
  std::string items;
  for (const Finding& finding : findings_of(input))
    items += fmt::format("<li class=\"{}\"><b>{}</b><span>{}</span></li>\n", finding.good ? "good" : "bad",
                         finding.good ? "✓" : "✕", html_escaped(finding.text));
  return fmt::format("<ul class=\"findings\">\n{}</ul>\n", items);
}

std::string link_to_view(const std::string& view) {
  if (view.empty()) return {};
  return fmt::format("<p><a href=\"{}\">Turn the robot around and move its joints</a></p>\n", html_escaped(view));
}

std::string head(const ReportInput& input, const std::string& view) {
  std::string format(prohull::name_of(robot_format_names(), input.file.format));
  std::ranges::transform(format, format.begin(), [](char c) { return 'a' <= c && c <= 'z' ? c - 'a' + 'A' : c; });
  return fmt::format(
      "<header>\n<p class=\"eyebrow\">Collision geometry report</p>\n<h1>{}</h1>\n"
      "<p class=\"muted\">{} · {} · {} · prohull {} · {} · {:.1f} s</p>\n{}{}</header>\n",
      html_escaped(input.file.robot.name), html_escaped(input.file.path.filename().string()), format,
      counted(input.file.robot.links.size(), "link"), html_escaped(input.version), input.date, input.seconds,
      findings(input), link_to_view(view));
}

std::string tile(const std::string& number, const std::string& words) {
  return fmt::format("<div class=\"card tile\"><b>{}</b><span>{}</span></div>\n", number, words);
}

std::string false_collisions_tile(const MotionResult& motion) {
  const std::size_t ours = motion.false_hull(), convex = motion.false_convex();
  if (convex == 0) return tile(grouped(ours), "false collisions; the convex hulls have none");
  const double change = 100 * (static_cast<double>(ours) / static_cast<double>(convex) - 1);
  return tile(fmt::format("{}{:.0f} %", change < 0 ? "−" : "+", std::abs(change)),
              fmt::format("false collisions: {}, where the convex hulls have {}", grouped(ours), grouped(convex)));
}

std::string size_tile(const Totals& totals) {
  const std::string before = grouped(totals.faces_before);
  if (totals.pieces + totals.balls == 0)
    return tile(fmt::format("{} → {}", before, grouped(totals.faces_after)), "faces of the geometry, and of its hulls");
  if (totals.pieces * totals.balls > 0)
    return tile(fmt::format("{} → {} + {}", before, grouped(totals.pieces), grouped(totals.balls)),
                "faces of the geometry; convex pieces and spheres");
  return tile(fmt::format("{} → {}", before, grouped(totals.pieces + totals.balls)),
              fmt::format("faces of the geometry, and {} around it", totals.pieces > 0 ? "convex pieces" : "spheres"));
}

std::string tiles(const ReportInput& input) {
  const Totals totals = totals_of(input);
  std::string text;
  if (totals.hulled > 0) {
    text += tile(fmt::format("{} of {}", totals.certified, totals.hulled),
                 fmt::format("links with {} are certified", cover_words(input.hulls)));
    text += size_tile(totals);
    text += tile(ratio_text(totals.volume_ratio), "volume / original volume (median)");
    text += tile(ratio_text(totals.convex_ratio), "volume / convex hull volume (median)");
  }
  if (input.motion) text += false_collisions_tile(*input.motion);
  if (totals.checked > 0)
    text += tile(fmt::format("{} of {}", totals.passed, totals.checked), "links pass the check of what was shipped");
  if (totals.checked > 0 && input.hulls.empty()) {
    text += tile(range_text(totals.sticks_out_at_least, totals.sticks_out_at_most),
                 "by which the visual geometry sticks out farthest");
    text += tile(ratio_text(totals.shipped_ratio), "shipped volume / original volume (median)");
  }
  return text;
}

std::string chip(std::string_view color, std::string_view words) {
  return fmt::format("<span class=\"chip\" style=\"--chip:{}\">{}</span>", color, words);
}

std::string legend(const ReportInput& input) {
  const std::string geometry = chip(kGrey, input.from == Geometry::Visual ? "visual geometry" : "geometry");
  return fmt::format(
      "<span class=\"legend\">{}{}</span>", geometry,
      input.hulls.empty() ? chip(kOrange, "shipped collision geometry") : chip(kBlue, cover_words(input.hulls)));
}

std::string overview(const ReportInput& input, const std::string& png) {
  const std::string picture =
      figure(png, fmt::format("The robot {} inside of its collision geometry", html_escaped(input.file.robot.name)),
             legend(input), {.width = kWide, .height = kHigh});
  return fmt::format("<div class=\"overview{}\">\n{}<div class=\"tiles\">\n{}</div>\n</div>\n",
                     picture.empty() ? " plain" : "",
                     picture.empty() ? "" : fmt::format("<div class=\"card\">{}</div>\n", picture), tiles(input));
}

std::string marks(const ReportInput& input) {
  std::string items;
  for (const Mark& mark : marks_of(input)) {
    const bool failure = mark.severity == Severity::Failure;
    items += fmt::format("<li class=\"{}\"><b>{}</b><span>{}: {}</span></li>\n", failure ? "bad" : "look",
                         failure ? "✕ Failure" : "! Look", link_to(input, mark.link), html_escaped(mark.text));
  }
  if (items.empty()) items = "<li class=\"good\"><b>✓</b><span>Nothing.</span></li>\n";
  return fmt::format(
      "<section>\n<h2>What needs a look</h2>\n<ul class=\"marks\">\n{}</ul>\n{}</section>\n", items,
      list("What was not read of the file", input.file.notes) + list("About the SRDF file", input.srdf_notes));
}

// ---------------------------------------------------------------------------------------------------------------------
// Links

Cell certificate(bool is_certified) {
  return is_certified ? Cell("✓ certified", "good") : Cell("✕ not certified", "bad");
}

Cell verdict(const LinkCheck& check, double allow) {
  const Cell cells[]{{"✓ covered", "good"},
                     {"✓ covered, but for rounding", "good"},
                     {"✓ within the allowance", "good"},
                     {"✕ leaks", "bad"},
                     {"! undecided", "look"},
                     {"✕ none", "bad"},
                     {"no visual"},
                     {"✕ not checked", "bad"}};
  return cells[static_cast<std::size_t>(standing(check, allow))];
}

std::string sticks_out(const LinkCheck& check) {
  if (!was_measured(check)) return kDash;
  return range_text(check.sticks_out_at_least, check.sticks_out_at_most);
}

std::string words_for(LinkStatus status) {
  constexpr const char* kWords[]{"", "keeps its primitives", "skipped", "not read", "no geometry"};
  return kWords[static_cast<std::size_t>(status)];
}

std::string part_ratio_text(const LinkHull& hull, const LinkHulls& link) {
  const auto part = ratio(hull.volume, link.sealed_volume);
  return (part && link.is_estimated ? "~ " : "") + ratio_text(part);
}

std::vector<Cell> hull_cells(const LinkHulls* hulls) {
  const LinkHull* const hull = hulls ? first_hull(*hulls) : nullptr;
  if (!hull) return {hulls ? words_for(hulls->status) : kDash, "", "", "", "", ""};
  return {certificate(is_certified(*hulls)),
          grouped(hulls->triangles.face_count()),
          hulls->collision == Collision::Hull ? grouped(hull->mesh.face_count()) : size_text(*hull),
          part_ratio_text(*hull, *hulls),
          ratio_text(ratio(hull->volume, hulls->convex_volume)),
          length_text(hull->verdict.distance().upper, Rounded::Up)};
}

/// An estimate, in which what is shorter is rounding.
std::string mean_text(double metres) { return metres < 1e-9 ? "less than 1 nm" : length_text(metres); }

std::vector<Cell> check_cells(const LinkCheck* check, double allow) {
  if (!check) return {};
  return {verdict(*check, allow), sticks_out(*check), ratio_text(ratio(check->collision_volume, check->visual_volume))};
}

std::string links_table(const ReportInput& input) {
  const auto both = [](auto first, auto second) {
    std::ranges::move(second, std::back_inserter(first));
    return first;
  };
  std::vector<std::string> heads{"Link"};
  const bool is_hull = cover_words(input.hulls) == "hulls";
  if (!input.hulls.empty())
    heads = {"Link",
             is_hull ? "Hull" : "Cover",
             "Faces before",
             is_hull ? "Faces after" : "Covered by",
             "Volume&nbsp;/ original",
             "Volume&nbsp;/ convex&nbsp;hull",
             "Distance at&nbsp;most"};
  if (!input.shipped.empty())
    heads = both(heads, std::vector<std::string>{"Shipped", "Sticks out by", "Shipped volume&nbsp;/ original"});
  std::string rows;
  for (std::size_t i = 0; i < input.file.robot.links.size(); ++i)
    rows += row(link_to(input, i), both(input.hulls.empty() ? std::vector<Cell>() : hull_cells(hulls_of(input, i)),
                                        check_cells(check_of(input, i), input.allow)));
  return fmt::format("<section>\n<h2>Links</h2>\n<div class=\"card list\">\n{}</div>\n</section>\n",
                     table("", heads, rows));
}

std::string built_from(const LinkHull& hull) {
  if (hull.source == "mesh") return "the repaired mesh";
  if (hull.source == "convex-hull") return "the convex hull";
  if (hull.source == "wrap") return "a wrap";
  if (hull.source.empty()) return kDash;
  return html_escaped(hull.source);
}

std::string count_in(std::size_t faces, const std::string& parts) {
  return parts.empty() ? grouped(faces) : fmt::format("{} in {}", grouped(faces), parts);
}

std::string faces_of(const LinkHull& hull, Collision collision) {
  if (collision != Collision::Hull && hull.pieces.empty()) return size_text(hull);
  return count_in(hull.mesh.face_count(), hull.pieces.empty() ? "" : size_text(hull));
}

std::string head_of(const LinkHull& hull, const LinkHulls& link) {
  if (link.collision != Collision::Hull) return "Cover";
  return link.hulls.size() == 1 ? "Hull" : fmt::format("Hull of {}", grouped(hull.target_faces));
}

/// "all triangles and the solid that they bound", "12,000 triangles without 2 that are not finite"
std::string proven_text(const Verdict& verdict) {
  std::string text = verdict.covers_triangles == Answer::Yes ? "all triangles" : "";
  if (verdict.encloses_solid == Answer::Yes) text += text.empty() ? "the solid" : " and the solid that they bound";
  if (verdict.cap_faces > 0)
    text += ", with " + counted(verdict.cap_faces, "face that closes its openings", "faces that close its openings");
  if (verdict.non_finite_faces > 0)
    text += fmt::format(", but {} not finite", counted(verdict.non_finite_faces, "that is", "that are"));
  return text;
}

/// A fact about hulls, and about what was shipped.
struct Fact {
  bool is_shown;
  const char* head;
  std::function<Cell(const LinkHull&)> of_hull;
  std::function<Cell(const LinkCheck&)> of_check;
};

std::vector<Fact> facts(const LinkHulls* link, std::span<const LinkHull> hulls, bool has_check, double allow) {
  using Hull = const LinkHull&;
  using Check = const LinkCheck&;
  const bool has_hulls = !hulls.empty(),
             is_padded = std::ranges::any_of(hulls, [](Hull h) { return h.verdict.gap.has_value(); });
  const auto unknown = [](const auto&) { return kDash; };
  const auto range = [](const DistanceBounds& bounds) { return range_text(bounds.lower, bounds.upper); };
  const auto times = [](double volume, double of) { return ratio_text(ratio(volume, of)); };
  return {{true, "Encloses the geometry", [](Hull h) { return certificate(h.certified()); },
           [=](Check c) { return verdict(c, allow); }},
          {has_check, "Geometry sticks out by", [](Hull h) { return h.certified() ? "0 mm" : "?"; }, sticks_out},
          {true, "Faces", [=](Hull h) { return faces_of(h, link->collision); },
           [](Check c) { return count_in(c.collision_faces, c.pieces > 1 ? counted(c.pieces, "piece") : ""); }},
          {true, "Volume / original", [=](Hull h) { return part_ratio_text(h, *link); },
           [=](Check c) { return times(c.collision_volume, c.visual_volume); }},
          {true, "Volume / convex hull", [=](Hull h) { return times(h.volume, link->convex_volume); },
           [=](Check c) { return times(c.collision_volume, c.convex_volume); }},
          {true, "Greatest distance from the geometry", [=](Hull h) { return range(h.verdict.distance()); },
           [=](Check c) { return range(c.reach); }},
          {std::ranges::any_of(hulls, &LinkHull::has_openings), "The same, from its triangles alone",
           [=](Hull h) { return range(*h.verdict.distance_to_triangles); }, unknown},
          {has_check, "Mean distance from the geometry", unknown, [](Check c) { return mean_text(c.mean_distance); }},
          {is_padded, "Padding, proven",
           [](Hull h) { return "at least " + length_text(h.verdict.gap.value_or(0), Rounded::Down); }, unknown},
          {has_hulls, "Proven to lie inside", [](Hull h) { return h.certified() ? proven_text(h.verdict) : kDash; },
           unknown},
          {has_hulls, "Proof", [](Hull h) { return h.certified() ? std::string(h.verdict.proof) : kDash; }, unknown},
          {has_hulls, "Built from", built_from, unknown}};
}

/// The facts about a link: a column for each hull, and one for what was shipped.
std::string facts_table(const LinkHulls* link, const LinkCheck* check, double allow) {
  if (check && !was_measured(*check)) check = nullptr;
  const std::span<const LinkHull> hulls = link ? std::span(link->hulls) : std::span<const LinkHull>();
  if (hulls.empty() && !check) return {};
  std::vector<std::string> heads{""};
  for (const LinkHull& hull : hulls) heads.push_back(head_of(hull, *link));
  if (check) heads.emplace_back("Shipped");
  std::string rows;
  for (const Fact& fact : facts(link, hulls, check, allow)) {
    if (!fact.is_shown) continue;
    std::vector<Cell> cells;
    for (const LinkHull& hull : hulls) cells.push_back(fact.of_hull(hull));
    if (check) cells.push_back(fact.of_check(*check));
    rows += row(fact.head, cells);
  }
  return fmt::format("<div class=\"facts\">{}</div>\n", table("", heads, rows));
}

std::string hull_figure(const std::string& png, const std::string& name, const LinkHull& hull, bool is_hull) {
  const std::string size = size_text(hull);
  return figure(png, fmt::format("{} inside of its translucent {}{}", name, is_hull ? "hull with " : "", size),
                chip(kBlue, (is_hull ? "Hull, " : "") + size), {});
}

std::string shipped_figure(const std::string& png, const std::string& name, const LinkCheck& check) {
  const bool leaks = check.sticks_out_at_least > 0;
  return figure(png,
                fmt::format("{} and its shipped collision geometry, translucent{}", name,
                            leaks ? "; a red ball marks where the link sticks out farthest" : ""),
                fmt::format("<span class=\"legend\">{}{}</span>",
                            chip(kOrange, fmt::format("Shipped, {}", counted(check.collision_faces, "face"))),
                            leaks ? chip(kRed, "sticks out farthest") : ""),
                {});
}

std::string pictures(const ReportInput& input, std::size_t link, const std::vector<std::string>& drawn) {
  const std::string name = name_of_link(input, link);
  const LinkHulls* const made = hulls_of(input, link);
  const std::size_t hulls = made ? made->hulls.size() : 0;
  std::string figures;
  for (std::size_t k = 0; k < drawn.size(); ++k)
    figures += k < hulls ? hull_figure(drawn[k], name, made->hulls[k], made->collision == Collision::Hull)
                         : shipped_figure(drawn[k], name, *check_of(input, link));
  return figures.empty() ? "" : fmt::format("<div class=\"pictures\">\n{}</div>\n", figures);
}

std::vector<std::string> notes_of(const LinkHulls* hulls, const LinkCheck* check) {
  std::vector<std::string> notes;
  const auto add = [&](const std::vector<std::string>& more) {
    for (const std::string& note : more)
      if (std::ranges::find(notes, note) == notes.end()) notes.push_back(note);
  };
  if (hulls)
    for (const LinkHull& hull : hulls->hulls) add(hull.notes);
  if (check) add(check->notes);
  return notes;
}

std::string facts_line(const LinkHulls& hulls) {
  const std::string_view covers = cover_words({&hulls, 1});
  std::string text;
  if (first_hull(hulls))
    text = fmt::format("The geometry has {}. ", counted(hulls.triangles.face_count(), "face"));
  else if (hulls.status == LinkStatus::Primitives)
    text = "Its primitives become the collision elements. ";
  if (!hulls.hulls.empty() && !hulls.primitives.empty())
    text += fmt::format("{} beside {}. ", counted(hulls.primitives.size(), "primitive is kept", "primitives are kept"),
                        hulls.collision == Collision::Hull ? "the hull" : covers);
  if (hulls.from_cache)
    text += fmt::format("The {} come from the cache.", covers);
  else if (first_hull(hulls))
    text += fmt::format("Its {} took {:.1f} s.", covers, hulls.seconds);
  return text.empty() ? "" : fmt::format("<p class=\"muted small\">{}</p>\n", text);
}

std::string badge(const ReportInput& input, std::size_t link) {
  const LinkHulls* const hulls = hulls_of(input, link);
  const Cell cell = !hulls               ? verdict(*check_of(input, link), input.allow)
                    : first_hull(*hulls) ? certificate(is_certified(*hulls))
                                         : Cell(words_for(hulls->status), "muted");
  return fmt::format("<span class=\"badge {}\">{}</span>", cell.kind, cell.text);
}

std::string card(const ReportInput& input, std::size_t link, const std::vector<std::string>& drawn, bool is_open) {
  const LinkHulls* const hulls = hulls_of(input, link);
  const LinkCheck* const check = check_of(input, link);
  if (!has_card(input, link)) return {};
  // A link to what is inside of a folded card opens it.
  std::string text = fmt::format(
      "<details class=\"card\"{}>\n<summary class=\"title\"><h3>{}</h3>{}</summary>\n<div id=\"link-{}\">\n",
      is_open ? " open" : "", name_of_link(input, link), badge(input, link), link);
  if (hulls) text += facts_line(*hulls);
  if (hulls && !hulls->why.empty()) text += fmt::format("<p>{}</p>\n", html_escaped(hulls->why));
  if (check && !was_measured(*check) && check->verdict != CheckVerdict::NoVisual)
    text += fmt::format("<p>The shipped collision geometry {}.</p>\n", verdict_text(*check));
  text +=
      fmt::format("<div class=\"body{}\">\n{}{}</div>\n",
                  std::ranges::count_if(drawn, [](const std::string& png) { return !png.empty(); }) == 1 ? " one" : "",
                  pictures(input, link, drawn), facts_table(hulls, check, input.allow));
  if (hulls) text += list("Repairs", hulls->repairs);
  text += list("Notes", notes_of(hulls, check));
  return text + "</div>\n</details>\n";
}

std::string cards(const ReportInput& input, const PagePictures& drawn) {
  constexpr std::size_t kFew = 3;
  std::vector<bool> is_open(drawn.cards.size(), drawn.cards.size() <= kFew);
  for (const Mark& mark : marks_of(input)) is_open[mark.link] = true;
  std::string text;
  for (std::size_t i = 0; i < drawn.cards.size(); ++i) text += card(input, i, drawn.cards[i], is_open[i]);
  return fmt::format("<section>\n<h2>Each link</h2>\n{}</section>\n", text);
}

// ---------------------------------------------------------------------------------------------------------------------
// Motion

Cell missed_cell(std::size_t missed) {
  return missed == 0 ? Cell("✓ 0", "good") : Cell(fmt::format("✕ {}", grouped(missed)), "bad");
}

std::string time_text(double microseconds) {
  return microseconds > 0 && std::isfinite(microseconds) ? fmt::format("{:.1f} µs", microseconds) : kDash;
}

std::string motion_summary(const MotionResult& m, const std::string& head) {
  const std::string rows =
      row("Visual geometry", {grouped(m.visual_configurations), grouped(m.sum(&MotionPair::visual)), kDash, kDash,
                              time_text(m.visual_us)}) +
      row("Convex hulls", {grouped(m.convex_configurations), grouped(m.sum(&MotionPair::convex)),
                           grouped(m.false_convex()), kDash, kDash}) +
      row(head, {grouped(m.hull_configurations), grouped(m.sum(&MotionPair::hull)), grouped(m.false_hull()),
                 missed_cell(m.missed()), time_text(m.hull_us)});
  return table("",
               {"Checked with", "Configurations in collision", "Pairs in collision", "False collisions",
                "Missed collisions", "Time per check of a pair"},
               rows);
}

std::vector<MotionPair> pairs_worth_showing(const MotionResult& motion) {
  std::vector<MotionPair> shown;
  std::ranges::copy_if(motion.pairs, std::back_inserter(shown), [](const MotionPair& p) {
    return p.kind != PairKind::Adjacent && p.visual + p.hull + p.convex + p.missed > 0;
  });
  std::ranges::stable_sort(shown, [](const MotionPair& a, const MotionPair& b) {
    return std::pair(a.missed, a.false_convex) > std::pair(b.missed, b.false_convex);
  });
  return shown;
}

std::string motion_pairs(const ReportInput& input) {
  std::string rows;
  for (const MotionPair& pair : pairs_worth_showing(*input.motion))
    rows += row(fmt::format("{} – {}", link_to(input, pair.a), link_to(input, pair.b)),
                {grouped(pair.visual), grouped(pair.false_convex), grouped(pair.false_hull), missed_cell(pair.missed)});
  if (rows.empty()) return "<p>No pair collides in any configuration.</p>\n";
  return table("Pairs of links that collide in some configuration",
               {"Pair", "Visual geometry collides", "False, convex hulls",
                fmt::format("False, {}", cover_words(input.hulls)), "Missed"},
               rows);
}

std::string motion_kinds(const MotionResult& motion) {
  const auto count = [&](PairKind kind) {
    return grouped(static_cast<std::size_t>(std::ranges::count(motion.pairs, kind, &MotionPair::kind)));
  };
  std::string proven;
  if (const PairVerdicts verdicts = verdicts_of(motion); verdicts.all() > 0)
    proven = fmt::format(
        " Of the other {}, by proof on the hulls: {} never meet within the limits of the joints, {} always do, {} meet "
        "at some position, {} stayed open.",
        counted(verdicts.all(), "pair"), verdicts.never, verdicts.always, verdicts.meets, verdicts.open);
  return fmt::format(
      "<p class=\"muted small\">Pairs that joints connect: {}.{} Sampled, which is no proof: {} that always collide, "
      "{} "
      "that never do.</p>\n",
      count(PairKind::Adjacent), proven, count(PairKind::Always), count(PairKind::Never));
}

std::string motion_section(const ReportInput& input) {
  if (!input.motion) return {};
  const std::string_view covers = cover_words(input.hulls);
  return fmt::format(
      "<section>\n<h2>In motion</h2>\n<div class=\"card\">\n<p>{} of the joints within their limits (seed {}). "
      "In each, every pair of links that are not adjacent was checked with the visual geometry, with the convex hulls, "
      "and with the {} of this report.</p>\n{}{}</div>\n<div class=\"card\">\n{}</div>\n</section>\n",
      counted(input.motion->configurations, "random configuration"), input.motion->seed, covers,
      motion_summary(*input.motion, covers == "hulls" ? "Hulls" : "Cover"), motion_kinds(*input.motion),
      motion_pairs(input));
}

std::string disabled_section(const ReportInput& input) {
  if (input.disabled.empty()) return {};
  std::string rows;
  for (const DisabledCheck& check : input.disabled)
    rows += row(html_escaped(fmt::format("{} – {}", check.row.link1, check.row.link2)),
                {html_escaped(check.row.reason), check.is_refuted() ? Cell("✕ refuted", "bad") : Cell("", ""),
                 html_escaped(verdict_text(check, input.file.robot))});
  return fmt::format("<section>\n<h2>Pairs that the SRDF disables</h2>\n<div class=\"card\">\n{}</div>\n</section>\n",
                     table("", {"Pair", "Reason", "", "Decided"}, rows));
}

// ---------------------------------------------------------------------------------------------------------------------
// The end of the page

std::string folded(std::string_view title, const std::string& content) {
  return fmt::format("<details class=\"card\">\n<summary class=\"title\"><h3>{}</h3></summary>\n{}</details>\n", title,
                     content);
}

std::string joints(const Robot& robot) {
  const std::vector<JointRange> ranges = allowed_ranges(robot);
  std::string rows;
  for (std::size_t j = 0; j < ranges.size(); ++j) {
    const Joint& joint = robot.joints[j];
    const auto limit = [&](double position) {
      if (!moves(joint) || !std::isfinite(position)) return std::string(kDash);
      return fmt::format("{:.6g} {}", position, turns(joint) ? "rad" : "m");
    };
    if (joint.type != JointType::Fixed)
      rows += row(html_escaped(joint.name),
                  {std::string(prohull::name_of(joint_type_names(), joint.type)), limit(ranges[j].lower),
                   limit(ranges[j].upper), joint.mimic ? html_escaped(robot.joints[joint.mimic->joint].name) : kDash});
  }
  if (rows.empty()) return {};
  return folded("Positions of the joints that count", table("", {"Joint", "Type", "From", "To", "Follows"}, rows));
}

std::string files(std::string_view title, const std::vector<HashedFile>& files) {
  std::string rows;
  for (const HashedFile& file : files)
    rows += row(html_escaped(file.path.generic_string()),
                {file.hash.empty() ? Cell("cannot be read", "bad") : Cell("<code>" + file.hash + "</code>")});
  if (rows.empty()) return {};
  return folded(title, table("As <code>xxhsum -H128</code> prints it: what has changed since is found, but no forgery",
                             {"File", "XXH128"}, rows));
}

std::string record(const ReportInput& input) {
  return fmt::format("<section>\n<h2>What this report is about</h2>\n{}{}{}</section>\n", joints(input.file.robot),
                     files("Files of the robot", input.sources), files("Files that were written", input.written));
}

struct Word {
  bool is_shown;
  std::string_view word, meaning;
};

std::string words(const ReportInput& input) {
  const bool hulls = !input.hulls.empty(), shipped = !input.shipped.empty(), moved = input.motion.has_value();
  std::string text;
  for (const auto& [is_shown, word, meaning] : std::initializer_list<Word>{
           {hulls, "Hull", "A closed mesh of few faces around the geometry of a link."},
           {hulls, "Cover", "Convex pieces, or spheres, that cover the geometry of a link together."},
           {hulls, "Certified",
            "An exact test, which shares no code with the construction, has shown that no point of the geometry lies "
            "outside of the hull, or of the cover. There is no tolerance."},
           {hulls, "Proof",
            "How that was shown: <i>enclosure</i> compares two closed meshes, <i>coverage</i> shows that the hull "
            "covers each triangle, <i>padding</i> that it keeps its distance besides, and <i>union</i> that convex "
            "pieces or spheres cover each triangle together."},
           {hulls, "Repair",
            "A change of the geometry before a hull was built, such as a cap on an opening. The hull encloses the "
            "triangles of the file all the same."},
           {true, "Volume / original",
            "The volume of the hull or cover by that of the sealed original: the geometry of the file with its "
            "openings closed. What it is above 1 is the void."},
           {true, "Void",
            "The space between a hull and the geometry within it. The less there is, the fewer false collisions."},
           {true, "Volume / convex hull",
            "The volume by that of the smallest convex body around the geometry, which is a common collision mesh."},
           {true, "Greatest distance",
            "How far the collision geometry reaches out of the geometry of the link. What lies inside of the link "
            "counts as 0. The bounds are proven. Openings count as closed: what closes them is no part of the file, "
            "and the distance from the triangles alone is told, too. If the geometry bounds no solid, distances are "
            "those from its triangles."},
           {shipped, "Mean distance",
            "The mean of the same distances over the surface of the collision geometry, estimated from samples."},
           {shipped, "Shipped", "The collision geometry that came with the file of the robot."},
           {shipped, "Leaks",
            "Some point of the visual geometry lies outside of the collision geometry: exactly there, a collision is "
            "not noticed."},
           {moved, "False collision", "Two hulls collide, but the visual geometry within them does not."},
           {moved, "Missed collision",
            "The visual geometry collides, but the hulls do not. Certified hulls miss none."}})
    if (is_shown) text += fmt::format("<dt>{}</dt><dd>{}</dd>\n", word, meaning);
  return fmt::format("<section>\n<h2>Words</h2>\n<div class=\"card\"><dl class=\"words\">\n{}</dl></div>\n</section>\n",
                     text);
}

}  // namespace

std::string html_escaped(std::string_view text) { return xml_escaped(clean_text(text)); }

std::string report_html(const ReportInput& input, const PageOptions& options) {
  const PagePictures drawn = drawn_pictures(input, options);
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>{0}: collision geometry report</title>\n<style>{1}</style>\n</head>\n<body>\n<main>\n"
      "{2}{3}{4}{5}{6}{7}{8}{9}<footer>Made by prohull {10}. Lengths of bounds are rounded to the safe side.</footer>\n"
      "</main>\n</body>\n</html>\n",
      html_escaped(input.file.robot.name), page_style(), head(input, options.view), overview(input, drawn.robot),
      marks(input), links_table(input), motion_section(input) + disabled_section(input), cards(input, drawn),
      record(input), words(input), html_escaped(input.version));
}

}  // namespace prohull::robot
