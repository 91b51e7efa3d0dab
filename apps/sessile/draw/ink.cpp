#include "draw/ink.h"

#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <system_error>

#include "draw/gl.h"
#include "sessile/core/error.h"

namespace sessile::draw {
namespace {

/// Where Linux systems keep sans-serif letters.
constexpr std::array<const char*, 8> letter_files{
    "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
    "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
    "/usr/share/fonts/TTF/DejaVuSans.ttf",
    "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf",
    "/usr/share/fonts/truetype/liberation2/LiberationSans-Regular.ttf",
    "/usr/share/fonts/truetype/noto/NotoSans-Regular.ttf",
    "/usr/share/fonts/truetype/freefont/FreeSans.ttf",
    "/usr/share/fonts/truetype/ubuntu/Ubuntu-R.ttf",
};

}  // namespace

float letter_size(float height) { return std::max(12.0F, std::round(0.031F * height)); }

ImFont* load_letters(float pixels) {
  ImFontAtlas* atlas = ImGui::GetIO().Fonts;
  for (const char* file : letter_files) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) continue;
    if (ImFont* font = atlas->AddFontFromFileTTF(file, pixels)) return font;
  }
  ImFontConfig config;
  config.SizePixels = 13 * std::max(1.0F, std::round(pixels / 13));  // of pixels; by whole factors it stays sharp
  return atlas->AddFontDefault(&config);
}

struct Ink::Impl {
  ImGuiContext* context = nullptr;
  int width, height;

  Impl(int w, int h) : width(w), height(h) {}
};

Ink::Ink(int width, int height) : impl_(std::make_unique<Impl>(width, height)) {
  IMGUI_CHECKVERSION();
  impl_->context = ImGui::CreateContext();
  ImGui::SetCurrentContext(impl_->context);
  ImGui::GetIO().IniFilename = nullptr;
  load_letters(letter_size(static_cast<float>(height)));
  if (!ImGui_ImplOpenGL3_Init("#version 330 core")) {
    ImGui::DestroyContext(impl_->context);
    throw Error(
        "the legend cannot be drawn: Dear ImGui finds no libGL.so.1; on Debian, apt-get install libgl1 brings it");
  }
}

Ink::~Ink() {
  ImGui::SetCurrentContext(impl_->context);
  ImGui_ImplOpenGL3_Shutdown();
  ImGui::DestroyContext(impl_->context);
}

void Ink::draw(unsigned framebuffer, const std::function<void()>& content) {
  ImGui::SetCurrentContext(impl_->context);
  ImGui::GetIO().DisplaySize = {static_cast<float>(impl_->width), static_cast<float>(impl_->height)};
  ImGui::GetIO().DeltaTime = 1.0F / 60;
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  ImGui_ImplOpenGL3_NewFrame();
  ImGui::NewFrame();
  content();
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  gl::check("drawing the legend");
}

}  // namespace sessile::draw
