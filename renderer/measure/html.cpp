#include "renderer/measure/html.h"

#include <cstdio>

namespace cutis {

std::string escapeHtml(const std::string& text) {
    std::string escaped;
    for (char c : text) {
        switch (c) {
            case '<':
                escaped += "&lt;";
                break;
            case '>':
                escaped += "&gt;";
                break;
            case '&':
                escaped += "&amp;";
                break;
            case '"':
                escaped += "&quot;";
                break;
            default:
                escaped += c;
        }
    }
    return escaped;
}

std::string htmlHead(const std::string& title) {
    return "<!doctype html>\n<html lang=en><meta charset=utf-8><title>" + escapeHtml(title) +
           "</title>\n<style>\n"
           "body{font:15px/1.5 system-ui,sans-serif;margin:2em auto;max-width:1200px;padding:0 "
           "1em;color:#222}\n"
           "table{border-collapse:collapse;font-size:13px}"
           "td,th{padding:.3em .6em;border-bottom:1px solid #ddd;text-align:left}\n"
           ".n{text-align:right;font-variant-numeric:tabular-nums}.front "
           "th{color:#c03040}.failed{color:#a00}\n"
           "td "
           "img{width:240px;vertical-align:middle}.plot{max-width:100%}code{background:#f2f2f2;padding:.1em "
           ".3em}\n"
           "</style>\n<h1>" +
           escapeHtml(title) + "</h1>\n";
}

std::string htmlNumber(const char* format, double value) {
    char text[64];
    std::snprintf(text, sizeof text, format, value);
    return std::string("<td class=n>") + text + "</td>";
}

}  // namespace cutis
