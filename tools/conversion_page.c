/* The report of a conversion as a page without scripts, fonts or images from elsewhere. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "conversion_report.h"

static const char style[] =
    ":root{--ink:#1d2430;--soft:#5b6675;--line:#dfe4ea;--paper:#fff;--back:#f4f6f8;--blue:#2f6fb2;--warn:#"
    "b25c00;"
    "--bad:#b3261e}\n"
    "*{box-sizing:border-box}\n"
    "body{margin:0;background:var(--back);color:var(--ink);font:15px/1.5 system-ui,-apple-system,'Segoe UI',"
    "Roboto,'DejaVu Sans',sans-serif}\n"
    "main{max-width:1080px;margin:0 auto;padding:32px 24px 64px}\n"
    "h1{font-size:28px;margin:0 0 4px;letter-spacing:-.01em}\n"
    "h2{font-size:18px;margin:0 0 12px}\nh3{font-size:14px;margin:20px 0 "
    "6px;color:var(--soft);font-weight:600}\n"
    "p{margin:0 0 8px}.soft{color:var(--soft)}\n"
    "section{background:var(--paper);border:1px solid var(--line);border-radius:10px;padding:20px "
    "22px;margin-top:18px}"
    "\n.tiles{display:flex;flex-wrap:wrap;gap:12px;margin-top:18px}\n"
    ".tile{flex:1 1 120px;background:var(--paper);border:1px solid "
    "var(--line);border-radius:10px;padding:12px 16px}\n"
    ".tile b{display:block;font-size:22px;font-weight:650;font-variant-numeric:tabular-nums}\n"
    ".tile span{color:var(--soft);font-size:13px}\n"
    ".scroll{overflow-x:auto}\n"
    "table{border-collapse:collapse;width:100%;font-size:14px}\n"
    "th,td{text-align:left;padding:5px 14px 5px 0;border-bottom:1px solid var(--line);vertical-align:top}\n"
    "th{color:var(--soft);font-weight:600;white-space:nowrap}\n"
    "td.n,th.n{text-align:right;font-variant-numeric:tabular-nums;white-space:nowrap}\n"
    ".facts{width:auto;min-width:45%}.facts td.n{text-align:left}\n"
    "tr:last-child td,tr:last-child th{border-bottom:0}\n"
    "ul{margin:0;padding:0;list-style:none}\n"
    "li{padding:7px 0;border-bottom:1px solid var(--line);overflow-wrap:anywhere}li:last-child{border:0}\n"
    "code{font:12px ui-monospace,'DejaVu Sans Mono',monospace;color:var(--soft)}\n"
    ".mark{display:inline-block;min-width:62px;margin-right:8px;padding:0 "
    "8px;border-radius:9px;font-size:12px;"
    "text-align:center;background:#e6edf5;color:var(--blue)}\n"
    ".mark.warning{background:#fbeede;color:var(--warn)}.mark.error{background:#fae5e3;color:var(--bad)}\n"
    ".figures{display:grid;grid-template-columns:repeat(auto-fit,minmax(430px,1fr));gap:18px}\n"
    "figure{margin:0}figure img{width:100%;height:auto;display:block;border-radius:8px;border:1px solid "
    "var(--line)}\n"
    "figcaption{margin-top:6px;font-size:13px;color:var(--soft)}figcaption b{color:var(--ink)}\n"
    ".charts{display:grid;grid-template-columns:repeat(auto-fill,minmax(280px,1fr));gap:22px}\n"
    "svg{width:100%;height:auto;display:block}svg text{font-size:10px;fill:var(--soft)}svg "
    "rect{fill:var(--blue)}\n"
    "svg line{stroke:var(--line)}\n"
    "@media(max-width:520px){.figures{grid-template-columns:1fr}}\n"
    "@media print{body{background:#fff}section,.tile{break-inside:avoid}}\n";

static const json_t *get(const json_t *object, const char *key) {
  return json_object_get(object, key);
}
static const char *text(const json_t *object, const char *key) {
  const char *found = json_string_value(get(object, key));
  return found ? found : "";
}
static long long whole(const json_t *object, const char *key) {
  return (long long)json_integer_value(get(object, key));
}
static double real(const json_t *object, const char *key) {
  return json_number_value(get(object, key));
}

/* Escapes text for an element or a quoted attribute. */
static void put(FILE *to, const char *s) {
  for (; *s; s++) switch (*s) {
    case '&':
      fputs("&amp;", to);
      break;
    case '<':
      fputs("&lt;", to);
      break;
    case '>':
      fputs("&gt;", to);
      break;
    case '"':
      fputs("&quot;", to);
      break;
    default:
      putc(*s, to);
    }
}

/* 1,234,567 */
static void put_whole(FILE *to, long long n) {
  char digits[32];
  int length = snprintf(digits, sizeof digits, "%lld", n);
  for (int i = 0; i < length; i++) {
    if (i && (length - i) % 3 == 0 && digits[i - 1] != '-') putc(',', to);
    putc(digits[i], to);
  }
}

static void put_cell(FILE *to, const char *s) {
  fputs("<td>", to);
  put(to, s);
  fputs("</td>", to);
}

static void put_number_cell(FILE *to, long long n) {
  fputs("<td class=\"n\">", to);
  put_whole(to, n);
  fputs("</td>", to);
}

static void put_tile(FILE *to, long long n, const char *what) {
  fputs("<div class=\"tile\"><b>", to);
  put_whole(to, n);
  fprintf(to, "</b><span>%s</span></div>\n", what);
}

/* --- Parts of the page --------------------------------------------------------------------------------- */

static void put_head(FILE *to, const json_t *r) {
  const json_t *bundle = get(r, "bundle"), *box = get(bundle, "bounds");
  fputs("<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>",
      to);
  put(to, text(bundle, "title"));
  fprintf(to, " - conversion</title>\n<style>\n%s</style></head>\n<body><main>\n<h1>", style);
  put(to, text(bundle, "title"));
  fputs("</h1>\n<p class=\"soft\">", to);
  put(to, text(json_array_get(get(r, "sources"), 0), "file"));
  fputs(" &rarr; ", to);
  put(to, text(r, "output"));
  fputs(", by ", to);
  put(to, text(r, "program"));
  fputs("</p>\n<div class=\"tiles\">\n", to);
  long long vertices = 0, polygons = 0;
  for (size_t i = 0; i < json_array_size(get(bundle, "render_meshes")); i++) {
    vertices += whole(json_array_get(get(bundle, "render_meshes"), i), "vertices");
    polygons += whole(json_array_get(get(bundle, "render_meshes"), i), "polygons");
  }
  put_tile(to, vertices, "vertices shown");
  put_tile(to, polygons, "polygons shown");
  put_tile(to, (long long)json_array_size(get(bundle, "bones")), "bones");
  put_tile(to, (long long)json_array_size(get(bundle, "sections")), "soft sections");
  put_tile(to, whole(get(get(r, "quality"), "springs"), "count"), "springs");
  put_tile(to, whole(bundle, "tetrahedra"), "tetrahedra");
  fputs("</div>\n", to);
  if (!json_is_object(box)) return;
  double size[3];
  for (size_t k = 0; k < 3; k++)
    size[k] = json_number_value(json_array_get(get(box, "max"), k)) -
              json_number_value(json_array_get(get(box, "min"), k));
  fprintf(to,
      "<p class=\"soft\" style=\"margin-top:12px\">%.4g m wide, %.4g m high, %.4g m long; %.4g kg of soft "
      "matter; ",
      size[0], size[1], size[2], real(bundle, "mass"));
  put_whole(to, whole(bundle, "bytes"));
  fputs(" bytes</p>\n", to);
}

static void put_pictures(FILE *to, const json_t *r) {
  const json_t *pictures = get(r, "pictures");
  fputs("<section><h2>What it looks like</h2>\n", to);
  if (text(r, "drawing_failed")[0]) {
    fputs("<p>No pictures could be drawn here: ", to);
    put(to, text(r, "drawing_failed"));
    fputs("</p>\n", to);
  }
  fputs("<div class=\"figures\">\n", to);
  for (size_t i = 0; i < json_array_size(pictures); i++) {
    const json_t *one = json_array_get(pictures, i);
    fprintf(to, "<figure><img alt=\"%s\" width=\"%lld\" height=\"%lld\" src=\"data:image/png;base64,%s\">\n",
        text(one, "title"), whole(one, "width"), whole(one, "height"), text(one, "png"));
    fprintf(to, "<figcaption><b>%s.</b> ", text(one, "title"));
    put(to, text(one, "caption"));
    fputs("</figcaption></figure>\n", to);
  }
  fputs("</div></section>\n", to);
}

/* Source of a unit or of axes. */
static const char *said_by(const char *who, const char *assumed) {
  return strcmp(who, "assumed") == 0 ? assumed
         : strcmp(who, "call") == 0  ? "by the call"
                                     : "as the file states";
}

/* No source has a word or a number above 0. */
static bool is_empty(const json_t *sources, const char *key) {
  for (size_t i = 0; i < json_array_size(sources); i++)
    if (text(json_array_get(sources, i), key)[0] || whole(json_array_get(sources, i), key)) return false;
  return true;
}

static void put_row(FILE *to, const json_t *sources, const char *label, const char *key) {
  if (is_empty(sources, key)) return;
  fprintf(to, "<tr><th>%s</th>", label);
  for (size_t i = 0; i < json_array_size(sources); i++) {
    const json_t *value = get(json_array_get(sources, i), key);
    if (json_is_string(value))
      put_cell(to, json_string_value(value));
    else
      put_number_cell(to, (long long)json_integer_value(value));
  }
  fputs("</tr>\n", to);
}

static void put_sources(FILE *to, const json_t *r) {
  static const char *const rows[][2] = {{"bytes", "bytes"}, {"objects", "objects"},
      {"vertices as stored", "vertices"}, {"points", "points"}, {"polygons", "polygons"},
      {"tetrahedra", "tetrahedra"}, {"bones", "bones"}, {"materials", "materials"}, {"images", "images"},
      {"clips", "clips"}};
  const json_t *sources = get(r, "sources");
  fputs("<section><h2>What came in</h2><div class=\"scroll\"><table class=\"facts\">\n", to);
  put_row(to, sources, "file", "file");
  put_row(to, sources, "form", "form");
  put_row(to, sources, "written by", "generator");
  fputs("<tr><th>unit</th>", to);
  for (size_t i = 0; i < json_array_size(sources); i++) {
    const json_t *s = json_array_get(sources, i);
    fprintf(to, "<td>%g m, %s</td>", real(s, "unit_m"), said_by(text(s, "unit_from"), "assumed"));
  }
  fputs("</tr>\n<tr><th>axes</th>", to);
  for (size_t i = 0; i < json_array_size(sources); i++)
    fprintf(to, "<td>%s</td>",
        said_by(text(json_array_get(sources, i), "axes_from"), "+Y up, +Z forward, assumed"));
  fputs("</tr>\n", to);
  size_t missing = 0;
  for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
    put_row(to, sources, rows[k][0], rows[k][1]);
    missing += is_empty(sources, rows[k][1]);
  }
  fputs("</table></div>\n", to);
  if (missing) fputs("<p class=\"soft\">Without ", to);
  for (size_t k = 0, listed = 0; k < sizeof rows / sizeof *rows; k++)
    if (is_empty(sources, rows[k][1]))
      fprintf(to, "%s%s", listed++ == 0 ? "" : listed == missing ? " and " : ", ", rows[k][0]);
  fputs(missing ? ".</p></section>\n" : "</section>\n", to);
}

static void put_messages(FILE *to, const json_t *list) {
  fputs("<ul>\n", to);
  for (size_t i = 0; i < json_array_size(list); i++) {
    const json_t *m = json_array_get(list, i);
    fprintf(to, "<li><span class=\"mark %s\">%s</span>", text(m, "severity"),
        strcmp(text(m, "severity"), "info") == 0 ? "note" : text(m, "severity"));
    put(to, text(m, "message"));
    fprintf(to, " <code>%s</code></li>\n", text(m, "code"));
  }
  fputs("</ul>\n", to);
}

/* Explains formats without a unit or axes, which no message reports because they are valid. */
static size_t count_assumed(const json_t *sources) {
  size_t count = 0;
  for (size_t i = 0; i < json_array_size(sources); i++) {
    const json_t *s = json_array_get(sources, i);
    count += strcmp(text(s, "unit_from"), "assumed") == 0 || strcmp(text(s, "axes_from"), "assumed") == 0;
  }
  return count;
}

static void put_assumed(FILE *to, const json_t *sources) {
  for (size_t i = 0; i < json_array_size(sources); i++) {
    const json_t *s = json_array_get(sources, i);
    bool unit = strcmp(text(s, "unit_from"), "assumed") == 0,
         axes = strcmp(text(s, "axes_from"), "assumed") == 0;
    if (!unit && !axes) continue;
    fputs("<p>", to);
    put(to, text(s, "file"));
    fprintf(to,
        " does not state its %s: %s assumed; <code>--unit</code> and <code>--up</code> know better.</p>\n",
        unit && axes ? "unit and axes"
        : unit       ? "unit"
                     : "axes",
        unit && axes ? "metres and +Y up are"
        : unit       ? "metres are"
                     : "+Y up is");
  }
}

static void put_findings(FILE *to, const json_t *r) {
  static const char *const kinds[][2] = {{"mended", "What was mended"}, {"guessed", "What was guessed"},
      {"lost", "What was lost"}, {"notes", "What else was said"}};
  for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
    const json_t *list = get(r, kinds[k][0]), *proposed = k == 1 ? get(r, "proposed") : NULL;
    size_t assumed = k == 1 ? count_assumed(get(r, "sources")) : 0;
    bool nothing = json_array_size(list) == 0 && json_array_size(proposed) == 0 && assumed == 0;
    if (nothing && strcmp(kinds[k][0], "notes") == 0) continue;
    fprintf(to, "<section><h2>%s</h2>\n", kinds[k][1]);
    if (nothing) fputs("<p class=\"soft\">Nothing.</p></section>\n", to);
    if (nothing) continue;
    if (assumed) put_assumed(to, get(r, "sources"));
    put_messages(to, list);
    if (json_array_size(proposed)) {
      fputs("<h3>Proposed, for a person to confirm</h3><p>", to);
      for (size_t i = 0; i < json_array_size(proposed); i++) {
        const json_t *p = json_array_get(proposed, i);
        fprintf(to, "%s%s <code>", i ? " &middot; " : "", text(p, "what"));
        put(to, text(p, "id"));
        fputs("</code>", to);
      }
      fputs("</p>\n", to);
    }
    fputs("</section>\n", to);
  }
}

/* Bars of a histogram; `low` and `high` label its ends. */
static void put_chart(FILE *to, const char *title, const json_t *bins, const char *low, const char *high) {
  size_t count = json_array_size(bins);
  double max = 1, width = 300.0 / (double)(count ? count : 1);
  for (size_t i = 0; i < count; i++) max = fmax(max, (double)json_integer_value(json_array_get(bins, i)));
  fprintf(to, "<div><h3>%s</h3><svg viewBox=\"0 0 300 112\" role=\"img\" aria-label=\"%s\">\n", title, title);
  fputs("<line x1=\"0\" y1=\"96.5\" x2=\"300\" y2=\"96.5\"/>\n", to);
  for (size_t i = 0; i < count; i++) {
    double n = (double)json_integer_value(json_array_get(bins, i)), height = 92 * n / max;
    if (n > 0 && height < 1) height = 1;
    fprintf(to,
        "<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" rx=\"1\"><title>%.0f</title></rect>\n",
        width * (double)i + 1, 96 - height, width - 2, height, n);
  }
  fprintf(to,
      "<text x=\"0\" y=\"109\">%s</text><text x=\"300\" y=\"109\" "
      "text-anchor=\"end\">%s</text></svg></div>\n",
      low, high);
}

static void put_quality(FILE *to, const json_t *r) {
  const json_t *q = get(r, "quality"), *t = get(q, "tetrahedra"), *s = get(q, "springs");
  char longest[32];
  if (!json_is_object(t) && !json_is_object(s)) return;
  fputs("<section><h2>How well the elements are shaped</h2>\n", to);
  if (json_is_object(t))
    fprintf(to,
        "<p>%lld tetrahedra, %lld inverted, %.4g m&sup3;. Dihedral angles from %.1f&deg; to %.1f&deg;; "
        "radius ratio "
        "%.3f at least, %.3f on average, where 1 is regular.</p>\n",
        whole(t, "count"), whole(t, "inverted"), real(t, "volume_m3"), real(t, "least_dihedral_deg"),
        real(t, "most_dihedral_deg"), real(t, "least_radius_ratio"), real(t, "mean_radius_ratio"));
  if (json_is_object(s))
    fprintf(to, "<p>%lld springs of %.4g to %.4g m, %.4g m on average.</p>\n", whole(s, "count"),
        real(s, "least_m"), real(s, "most_m"), real(s, "mean_m"));
  fputs("<div class=\"charts\">\n", to);
  if (json_is_object(t)) {
    put_chart(to, "Dihedral angles", get(t, "dihedrals"), "0&deg;", "180&deg;");
    put_chart(to, "Radius ratios", get(t, "radius_ratios"), "0 flat", "1 regular");
  }
  if (json_is_object(s)) {
    snprintf(longest, sizeof longest, "%.4g m", real(s, "most_m"));
    put_chart(to, "Lengths of springs", get(s, "lengths"), "0", longest);
  }
  fputs("</div></section>\n", to);
}

static void put_render_levels(FILE *to, const json_t *r) {
  const json_t *meshes = get(get(r, "bundle"), "render_meshes");
  size_t count = 0;
  for (size_t m = 0; m < json_array_size(meshes); m++)
    count += json_array_size(get(json_array_get(meshes, m), "levels"));
  if (count == 0) return;
  fputs("<section><h2>Render levels</h2><div class=\"scroll\"><table><tr><th>mesh</th><th "
        "class=\"n\">level</th>"
        "<th class=\"n\">triangles</th><th class=\"n\">farthest off, m</th></tr>\n",
      to);
  for (size_t m = 0; m < json_array_size(meshes); m++) {
    const json_t *mesh = json_array_get(meshes, m), *levels = get(mesh, "levels");
    for (size_t l = 0; l < json_array_size(levels); l++) {
      const json_t *level = json_array_get(levels, l);
      fputs("<tr>", to);
      put_cell(to, text(mesh, "name"));
      put_number_cell(to, (long long)l + 1);
      put_number_cell(to, whole(level, "triangles"));
      fprintf(to, "<td class=\"n\">%.3g</td></tr>\n", real(level, "error"));
    }
  }
  fputs("</table></div></section>\n", to);
}

static void put_sections(FILE *to, const json_t *r) {
  const json_t *sections = get(get(r, "bundle"), "sections"), *bodies = get(get(r, "quality"), "bodies");
  if (json_array_size(sections) == 0) return;
  fputs("<section><h2>Sections</h2><div class=\"scroll\"><table><tr><th>name</th><th>bone</th><th "
        "class=\"n\">vertices</th>"
        "<th class=\"n\">polygons</th><th class=\"n\">interior</th><th class=\"n\">springs</th>"
        "<th class=\"n\">tetrahedra</th><th class=\"n\">least angle</th><th class=\"n\">pins</th></tr>\n",
      to);
  for (size_t i = 0; i < json_array_size(sections); i++) {
    const json_t *s = json_array_get(sections, i), *q = json_array_get(bodies, i), *t = get(q, "tetrahedra");
    fputs("<tr>", to);
    put_cell(to, text(s, "name"));
    put_cell(to, text(s, "bone"));
    put_number_cell(to, whole(s, "vertices"));
    put_number_cell(to, whole(s, "polygons"));
    put_number_cell(to, whole(s, "interior_points"));
    put_number_cell(to, whole(get(q, "springs"), "count"));
    put_number_cell(to, whole(s, "tetrahedra"));
    if (json_is_object(t))
      fprintf(to, "<td class=\"n\">%.1f&deg;</td>", real(t, "least_dihedral_deg"));
    else
      fputs("<td class=\"n\"></td>", to);
    put_number_cell(to, whole(s, "pins"));
    fputs("</tr>\n", to);
  }
  fputs("</table></div></section>\n", to);
}

static void put_levels(FILE *to, const json_t *r) {
  const json_t *sections = get(get(r, "bundle"), "sections");
  bool any = false;
  for (size_t i = 0; i < json_array_size(sections); i++) {
    const json_t *section = json_array_get(sections, i), *levels = get(section, "levels");
    for (size_t l = 0; l < json_array_size(levels); l++) {
      const json_t *level = json_array_get(levels, l), *c = get(level, "calibration");
      if (!json_is_number(get(level, "cost")) && !json_is_object(c)) continue;
      if (!any)
        fputs("<section><h2>Levels, measured</h2><p>How far a surface lies from where a fine lattice of the "
              "same matter has it: under gravity in metres, and under small loads as a share of the "
              "displacement. Cost: visits of elements a control tick.</p><div class=\"scroll\"><table>"
              "<tr><th>section</th><th>level</th><th>model</th><th class=\"n\">stiffness &times;</th>"
              "<th class=\"n\">left over</th><th class=\"n\">period</th><th class=\"n\">error, m</th>"
              "<th class=\"n\">cost</th></tr>\n",
            to);
      any = true;
      fputs("<tr>", to);
      put_cell(to, text(section, "name"));
      put_cell(to, text(level, "name"));
      put_cell(to, text(level, "model"));
      if (json_is_object(c))
        fprintf(to,
            "<td class=\"n\">%.2f</td><td class=\"n\">%.1f&thinsp;%%</td><td "
            "class=\"n\">%+.1f&thinsp;%%</td>",
            real(c, "factor"), 100 * real(c, "residual"), 100 * real(c, "period_error"));
      else
        fputs("<td></td><td></td><td></td>", to);
      if (json_is_number(get(level, "error")))
        fprintf(to, "<td class=\"n\">%.2g</td>", real(level, "error"));
      else
        fputs("<td class=\"n\">not measured</td>", to);
      fprintf(to, "<td class=\"n\">%.0f</td></tr>\n", real(level, "cost"));
    }
  }
  if (any) fputs("</table></div></section>\n", to);
}

static void put_clips(FILE *to, const json_t *r) {
  const json_t *clips = get(r, "clips");
  if (json_array_size(clips) == 0) return;
  fputs("<section><h2>Clips</h2><table><tr><th>name</th><th class=\"n\">seconds</th><th "
        "class=\"n\">tracks</th></tr>\n",
      to);
  for (size_t i = 0; i < json_array_size(clips); i++) {
    const json_t *c = json_array_get(clips, i);
    fputs("<tr>", to);
    put_cell(to, text(c, "name"));
    fprintf(to, "<td class=\"n\">%.2f</td>", real(c, "seconds"));
    put_number_cell(to, whole(c, "tracks"));
    fputs("</tr>\n", to);
  }
  fputs("</table></section>\n", to);
}

bool conversion_page_print(const json_t *r, FILE *to) {
  put_head(to, r);
  put_pictures(to, r);
  put_sources(to, r);
  put_findings(to, r);
  put_quality(to, r);
  put_sections(to, r);
  put_levels(to, r);
  put_render_levels(to, r);
  put_clips(to, r);
  fputs("</main></body></html>\n", to);
  return !ferror(to);
}
